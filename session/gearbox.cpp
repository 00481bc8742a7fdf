// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/session/gearbox.h"

#include <algorithm>
#include <mutex>

#include "trueflank/design/design_file.h"
#include "trueflank/export/number_text.h"

namespace trueflank {
namespace {

constexpr double kWidestKerf_mm = 20.0;

Status take_process(DesignFile& file, const std::string& name) {
  if (name.empty()) return {};
  const Process* process = file.tools.processes.find(name);
  if (!process) {
    std::string known;
    for (const std::string& other : names_of(file.tools.processes))
      known += (known.empty() ? "" : ", ") + other;
    return fail({.code = ErrorCode::kUsage, .message = "no such process",
                 .key = "--process", .value = name, .remedy = known});
  }
  file.design.made.process = *process;
  return {};
}

}  // namespace

Errors errors_of(const MadeOptions& options) {
  if (!options.kerf_mm || (*options.kerf_mm >= 0.0 && *options.kerf_mm <= kWidestKerf_mm)) return {};
  return {{.code = ErrorCode::kUsage,
           .message = "no width of a cut",
           .key = "--kerf-mm",
           .value = io::decimal_text(*options.kerf_mm),
           .remedy = "0 to 20"}};
}

struct Gearbox::Parts {
  std::once_flag made;
  std::optional<ResultAll<PartShapes>> shapes;
};

Gearbox::Gearbox(DesignFile file, GearTrain train)
    : file_(std::make_shared<const DesignFile>(std::move(file))),
      train_(std::make_shared<const GearTrain>(std::move(train))),
      parts_(std::make_shared<Parts>()) {}

ResultAll<Gearbox> Gearbox::of_file(ResultAll<DesignFile> file, const MadeOptions& made) {
  if (!file) return fail_all(file.error());
  if (Errors errors = errors_of(made); !errors.empty()) return fail_all(std::move(errors));
  if (auto ok = take_process(*file, made.process); !ok) return fail_all({ok.error()});
  if (made.kerf_mm) file->design.made.kerf_mm = made.kerf_mm;
  auto train = lay_out(file->design);
  if (!train) return fail_all(trueflank::located(train.error(), *file));
  return Gearbox(std::move(*file), std::move(*train));
}

ResultAll<Gearbox> Gearbox::read(const std::string& path, const MadeOptions& made) {
  return of_file(read_design_file(path), made);
}

ResultAll<Gearbox> Gearbox::read_text(std::string_view text, const std::string& file,
                                      const MadeOptions& made) {
  return of_file(read_design_file_text(text, file), made);
}

ResultAll<Gearbox> Gearbox::of(GearboxDesign design) {
  return of_file(DesignFile{.design = std::move(design), .file = {}, .lines = {}}, {});
}

Result<const TrainGear*> Gearbox::gear(const std::string& name) const {
  if (name.empty() && train_->gears.size() == 1) return &train_->gears.front();
  std::string names;
  for (const TrainGear& gear : train_->gears) {
    if (gear.name == name) return &gear;
    names += (names.empty() ? "" : ", ") + gear.name;
  }
  return fail({.code = ErrorCode::kUsage, .message = "this design has no such gear", .key = "gear",
               .value = name, .remedy = names});
}

const ResultAll<PartShapes>& Gearbox::parts() const {
  std::call_once(parts_->made, [this] {
    parts_->shapes = part_shapes(train_);
    if (!*parts_->shapes) parts_->shapes = fail_all(located(parts_->shapes->error()));
  });
  return *parts_->shapes;
}

bool Gearbox::speaks_inches() const {
  return std::any_of(file_->lines.begin(), file_->lines.end(), [](const auto& line) {
    return line.first.ends_with("_in") || line.first.ends_with(".diametral_pitch");
  });
}

Errors Gearbox::located(Errors errors) const {
  return trueflank::located(std::move(errors), *file_);
}

}  // namespace trueflank
