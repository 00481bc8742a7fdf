// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/app/command_line.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <sstream>

#include "trueflank/app/command_search.h"
#include "trueflank/app/command_shifts.h"
#include "trueflank/app/commands.h"
#include "trueflank/app/error_text.h"
#include "trueflank/app/suggestion.h"
#include "trueflank/app/terminal.h"
#include "trueflank/export/file_formats.h"
#include "trueflank/session/new_design_file.h"

namespace trueflank::app {
namespace {

void add_check(CLI::App& program, CheckOptions& options, int& code) {
  CLI::App* command = program.add_subcommand("check", "every check of a design, as a table");
  command->add_option("DESIGN", options.design, "design file (TOML)")->required();
  command->add_option("--json", options.json, "write the report as JSON here (- is standard output)");
  command->add_option("--html", options.html, "write the report as one HTML page here");
  command->add_option("--tolerance", options.tolerance,
                      "what tolerances leave: a class of ISO 1328-1 (7), and/or centre_distance_um=20,"
                      "tooth_thickness_um=10,runout_um=15,pitch_um=5,class=7");
  command->add_option("--material", options.material,
                      "of every gear, for torque and inertia (docs/strength.md)");
  command->add_option("--materials", options.materials_file,
                      "file with more [material.NAME] tables");
  command->add_option("--process", options.process,
                      "how the parts are made: warns of what that cannot make (docs/made.md)");
  command->add_option("--pictures", options.pictures,
                      "draw each mesh at its worst place, an SVG in this folder");
  command->add_flag("--verbose,-v", options.verbose, "the checks that passed too, each in its line");
  command->add_flag("--quiet,-q", options.quiet, "print no table; the exit code is the answer");
  command->callback([&] { code = run_check(options); });
}

void add_make(CLI::App& program, MakeOptions& options, int& code) {
  CLI::App* command =
      program.add_subcommand("make", "checks, then parts and assembly in every format asked for");
  command->add_option("DESIGN", options.design, "design file (TOML)")->required();
  command->add_option("--output,-o", options.folder, "folder for the files; created if need be")
      ->required();
  command->add_option("--formats", options.formats,
                      "comma-separated: " + io::format_names(",") + " (default: all but " +
                          io::asked_format_names(",") + ")")
      ->delimiter(',');
  command->add_option("--tolerance-um", options.tolerance_um,
                      "largest distance of a facet from the true surface")
      ->capture_default_str();
  command->add_option("--step-schema", options.step_schema,
                      "of STEP files: ap214, or ap242 with sizes, limits, datum and runouts")
      ->capture_default_str();
  command->add_option("--part", options.part, "only this part");
  command->add_option("--correct", options.correct,
                      "loop.json: write geometry that cancels the effects found");
  command->add_option("--materials", options.materials_file,
                      "file with more [material.NAME] tables");
  command->add_flag("--compensate", options.compensate,
                    "meshes with walls moved against the process's horizontal expansion; with "
                    "--correct as those of the measured part were");
  command->add_option("--kerf-mm", options.kerf_mm,
                      "DXF files of parts hold the path of a wire or beam that cuts this width");
  command->add_option("--process", options.process,
                      "how the parts are made: warns of what that cannot make (docs/made.md)");
  command->add_flag("--allow-failing", options.allow_failing,
                    "write the parts though a check failed (the exit code is still 1)");
  command->add_flag("--verbose,-v", options.verbose, "the checks that passed too, each in its line");
  command->add_flag("--quiet,-q", options.quiet, "print no table; the exit code is the answer");
  command->callback([&] { code = run_make(options); });
}

void add_search(CLI::App& program, SearchOptions& options, int& code) {
  CLI::App* command = program.add_subcommand(
      "search", "tooth numbers exhaustively, shifts and centre distance continuously");
  command->add_option("REQUIREMENTS", options.requirements, "requirements file (TOML)")->required();
  command->add_option("--output,-o", options.folder, "folder for the files; created if need be")
      ->required();
  command->add_option("--threads", options.threads, "0: one per processor")
      ->check(CLI::Range(0, 1024));
  command->add_option("--materials", options.materials, "file with more [material.NAME] tables");
  command->add_flag("--resume", options.resume, "go on where the folder's journal ends");
  command->add_option("--shard", options.shard, "i/n: only this part, for --merge");
  command->add_option("--merge", options.merge, "folders of all parts: their answer as one");
  command->add_flag("--quiet,-q", options.quiet, "no summary, no progress");
  command->callback([&] { code = run_search(options); });
}

void add_shifts(CLI::App& program, ShiftsOptions& options, int& code) {
  CLI::App* command = program.add_subcommand(
      "shifts", "the efficiency of one tooth set over its shifts, with every limit's border");
  command->add_option("REQUIREMENTS", options.requirements, "requirements file (TOML)")->required();
  command->add_option("--teeth", options.teeth, "of a search's set, for example 12/39/90/32/81")
      ->required();
  command->add_option("--output,-o", options.folder, "folder for the files; created if need be")
      ->required();
  command->add_option("--points", options.points, "along each axis")
      ->check(CLI::Range(11, 501))
      ->capture_default_str();
  command->add_flag("--quiet,-q", options.quiet, "no summary");
  command->callback([&] { code = run_shifts(options); });
}

void add_fix(CLI::App& program, FixCommand& options, int& code) {
  CLI::App* command = program.add_subcommand("fix", "the smallest change of a design after which every check passes");
  command->add_option("DESIGN", options.design, "design file (TOML)")->required();
  command->add_option("--output,-o", options.output,
                      "the mended design file, with its comments (- is standard output)")
      ->required();
  command->add_flag("--warnings", options.warnings,
                    "also change a design that passes, where that ends warnings about the contact");
  command->add_flag("--quiet,-q", options.quiet, "print no table; the exit code is the answer");
  command->callback([&] { code = run_fix(options); });
}

void add_compare(CLI::App& program, CompareOptions& options, int& code) {
  CLI::App* command =
      program.add_subcommand("compare", "are two mesh files the same shape? exit code 1: no");
  command->add_option("GOLDEN", options.golden, "the mesh that is right")->required();
  command->add_option("NEW", options.fresh, "the mesh to compare with it")->required();
  command->add_option("--tolerance-um", options.tolerance_um, "largest distance that counts as same")
      ->capture_default_str();
  command->add_option("--json", options.json, "write the figures as JSON here (- is standard output)");
  command->add_option("--picture", options.picture, "draw the worst place as SVG here");
  command->add_flag("--quiet,-q", options.quiet, "print no table; the exit code is the answer");
  command->callback([&] { code = run_compare(options); });
}

void add_loop(CLI::App& program, LoopOptions& options, int& code) {
  CLI::App* command = program.add_subcommand(
      "loop", "closes the loop with measured data: which effect does the model lack?");
  command->add_option("DESIGN", options.design, "design file (TOML)")->required();
  command->add_option("DATA", options.data,
                      "measured files: scans (.ply .stl .obj .xyz .csv), inspection and size tables "
                      "(.csv), MKA, GDE, PART=FILE where they are of several parts; or bench tables "
                      "(.csv) of the whole drive")
      ->required();
  command->add_option("--output,-o", options.folder, "folder for loop.json and loop.html")
      ->required();
  command->add_option("--gear", options.gear, "the gear that was measured");
  command->add_option("--effects", options.effects,
                      "effects of your own to look for, beside the library's (TOML, docs/loop.md)");
  command->add_flag("--aligned", options.aligned,
                    "scans stand in the gear's own frame: a displaced tooth system is an effect");
  command->add_flag("--quiet,-q", options.quiet, "no summary");
  command->callback([&] { code = run_loop(options); });
}

void add_new(CLI::App& program, NewOptions& options, int& code) {
  CLI::App* command = program.add_subcommand("new", "a commented design file to start from");
  command->add_option("NAME", options.name, "name of the design; NAME.toml is written")->required();
  command->add_option("--kind", options.kind, new_design_kinds())->capture_default_str();
  CLI::Option* ratio = command->add_option(
      "--ratio", options.ratio, "search teeth for this ratio (3k, stepped, simple, two-stage, pair)");
  const auto wish = [&](const char* flag, auto& value, const char* what) {
    command->add_option(flag, value, what)->needs(ratio)->capture_default_str();
  };
  wish("--input", options.input, "what is driven: sun, or carrier (3k)");
  wish("--output", options.output, "what drives out: ring1 or ring2 (3k), carrier or ring");
  wish("--motor", options.motor, "motor of the table: with a housing around the gears");
  wish("--process", options.process, "how it is made");
  wish("--material", options.material, "of the gears");
  wish("--tools", options.tools, "TOML file with own motors and processes");
  wish("--bed", options.bed, "printer's bed, by name or as 250x210: make writes print plates for it");
  wish("--outer-diameter", options.outer_diameter_mm, "of the whole, mm, at most");
  command->callback([&, ratio] {
    options.wished = ratio->count() > 0;
    code = run_new(options);
  });
}

/// Lines of help broken at 80 columns; what follows stands under the descriptions.
std::string wrapped(const std::string& text) {
  constexpr std::size_t kColumns = 80, kDescription = 30;
  std::string result;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    while (line.size() > kColumns) {
      auto end = line.rfind(' ', kColumns);
      if (end == std::string::npos || end <= kDescription) end = line.rfind(',', kColumns - 1) + 1;
      if (end <= kDescription) break;
      result += line.substr(0, end) + "\n";
      line = std::string(kDescription, ' ') + line.substr(end + (line[end] == ' ' ? 1 : 0));
    }
    result += line + "\n";
  }
  return result;
}

std::vector<std::string> command_names(const CLI::App& program) {
  std::vector<std::string> names;
  for (const CLI::App* command : program.get_subcommands({})) names.push_back(command->get_name());
  return names;
}

/// `trueflank help` and `trueflank help COMMAND` as the same with --help. Arguments in order.
std::vector<std::string> with_help_asked(const CLI::App& program, int argc, char** argv) {
  std::vector<std::string> words(argv + std::min(argc, 1), argv + argc);
  if (words.empty() || words.front() != "help") return words;
  words.erase(words.begin());
  words.resize(std::min<std::size_t>(words.size(), words.empty() || words.front() == "help" ? 0 : 1));
  const auto commands = command_names(program);
  const bool known = words.empty() || std::find(commands.begin(), commands.end(), words.front()) != commands.end();
  if (known) words.push_back("--help");  // else the word alone is said to be no command
  return words;
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

/// An error about a word that is no command: the nearest one, or all.
Error no_such_command(const CLI::App& program, const std::string& word) {
  const std::vector<std::string> commands = command_names(program);
  std::vector<std::string> known = commands;
  known.emplace_back("help");
  Error error{.code = ErrorCode::kUsage, .message = "no such command", .key = word};
  if (const std::string nearest = nearest_word(word, known); !nearest.empty())
    error.message += "; did you mean " + nearest + "?";
  else if (word.ends_with(".toml"))
    error.message += "; did you mean trueflank check " + word + "?";
  else
    error.remedy = joined(commands);
  return error;
}

/// An error about an option that a command does not have.
Error no_such_option(const CLI::App& command, const std::string& word) {
  std::vector<std::string> options;
  for (const CLI::Option* option : command.get_options())
    for (const std::string& name : option->get_lnames()) options.push_back("--" + name);
  Error error{.code = ErrorCode::kUsage,
              .message = "trueflank " + command.get_name() + " has no such option",
              .key = word,
              .remedy = "see trueflank " + command.get_name() + " --help"};
  if (const std::string nearest = nearest_word(word.substr(0, word.find('=')), options); !nearest.empty()) {
    error.message += "; did you mean " + nearest + "?";
    error.remedy.clear();
  }
  return error;
}

/// What a person who mistyped needs to know.
Error usage_error(const CLI::App& program, const CLI::ParseError& error) {
  const auto chosen = program.get_subcommands();
  // a word that starts with no dash comes first: what follows a mistyped command is not to blame
  for (const std::string& word : program.remaining(true)) {
    if (word.empty() || word == "--") continue;
    if (chosen.empty() && word.front() != '-') return no_such_command(program, word);
    if (!chosen.empty() && word.starts_with("--")) return no_such_option(*chosen.front(), word);
  }
  return {.code = ErrorCode::kUsage, .message = error.what(), .remedy = "see trueflank --help"};
}

}  // namespace

std::string welcome_text() {
  return "trueflank turns a gearbox design into exact gears and learns from measured ones\n"
         "\n"
         "  trueflank new mydrive --kind 3k         a commented design file to start from\n"
         "  trueflank check mydrive.toml            will it fit, turn and last?\n"
         "  trueflank fix mydrive.toml -o fixed.toml\n"
         "                                          the smallest change that mends it\n"
         "  trueflank make mydrive.toml -o parts    STL, 3MF, STEP and more, with a report\n"
         "  trueflank search needs.toml -o designs  find tooth numbers and profile shifts\n"
         "  trueflank loop mydrive.toml scan.stl --gear sun -o loop\n"
         "                                          what the measurements show\n"
         "  trueflank compare golden.stl new.stl    same shape? for continuous integration\n"
         "\n"
         "trueflank help COMMAND explains one command.\n";
}

int run_command_line(int argc, char** argv) {
  CLI::App program("Gear geometry: checked, made, measured and corrected.", "trueflank");
  program.set_version_flag("--version", "trueflank " TRUEFLANK_VERSION);
  program.require_subcommand(0, 1);
  program.footer("trueflank help COMMAND explains one command.");
  int code = 0;
  CheckOptions check;
  MakeOptions make;
  FixCommand fix;
  CompareOptions compare;
  NewOptions fresh;
  LoopOptions loop;
  SearchOptions search;
  ShiftsOptions shifts;
  add_check(program, check, code);
  add_make(program, make, code);
  add_fix(program, fix, code);
  add_compare(program, compare, code);
  add_new(program, fresh, code);
  add_loop(program, loop, code);
  add_search(program, search, code);
  add_shifts(program, shifts, code);
  try {
    std::vector<std::string> words = with_help_asked(program, argc, argv);
    std::reverse(words.begin(), words.end());  // as the parser takes them
    program.parse(std::move(words));
  } catch (const CLI::Success& asked) {  // --help, --version
    std::ostringstream text;
    const int asked_code = program.exit(asked, text, std::cerr);
    if (auto ok = print(wrapped(text.str())); !ok) return report_errors({ok.error()});
    return asked_code;
  } catch (const CLI::ParseError& error) {
    return report_errors({usage_error(program, error)});
  }
  if (program.get_subcommands().empty()) {
    if (auto ok = print(welcome_text()); !ok) return report_errors({ok.error()});
  }
  return code;
}

}  // namespace trueflank::app
