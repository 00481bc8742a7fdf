// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/session/job_size.h"

#include <algorithm>
#include <cmath>

#include "trueflank/base/number_text.h"
#include "trueflank/base/units.h"
#include "trueflank/geometry/scalar_root.h"
#include "trueflank/solid/mesh/mesh_estimate.h"

namespace trueflank {
namespace {

/// The mesh, what measuring keeps of it and what the writers hold, a facet; measured:
/// docs/reliability.md.
constexpr double kMemoryOfFacet_bytes = 220.0;
/// Of corrected teeth: displacements that a facet takes until it is measured, and operations a second. Measured:
/// waves of a million facets take 18 s of a processor.
constexpr double kDisplacementsOfFacet = 35.0, kOperationsOfSecond = 1e9;
/// Coarsest tolerance that make takes.
constexpr double kCoarsest_mm = 1.0;

/// A facet in a file, about.
double bytes_of_facet(io::FileFormat format) {
  switch (format) {
    case io::FileFormat::kStl:
      return 50.0;
    case io::FileFormat::k3mf:
      return 14.0;
    case io::FileFormat::kObj:
      return 45.0;
    case io::FileFormat::kPly:
      return 26.0;
    case io::FileFormat::kGlb:
      return 22.0;
    default:
      return 0.0;
  }
}

bool is_displaced(const Outline& outline) {
  const auto* toothed = std::get_if<ToothedOutline>(&outline);
  return toothed != nullptr && toothed->displacement != nullptr;
}
bool is_displaced(const PartShape& part) {
  return std::any_of(part.slabs.begin(), part.slabs.end(), [](const Slab& slab) {
    return is_displaced(slab.outer) ||
           std::any_of(slab.holes.begin(), slab.holes.end(),
                       [](const Outline& hole) { return is_displaced(hole); });
  });
}

bool is_too_large(const JobSize& size) {
  return size.facets > kMostFacets || size.file_bytes > kMostFileBytes ||
         size.correcting_s > kMostCorrecting_s;
}

/// "41 million"
std::string count_text(double count) {
  if (count < 1e6) return printed_number(count, "%.0f");
  return count < 1e9 ? printed_number(1e-6 * count, "%.3g") + " million"
                     : printed_number(1e-9 * count, "%.3g") + " thousand million";
}

/// The finest tolerance, in two digits, of a job that is not too large; 0: none is.
double tolerance_that_would_do_um(const PartShapes& shapes,
                                  const std::vector<io::FileFormat>& formats,
                                  const std::string& part, double tolerance_mm,
                                  double operations) {
  const auto does = [&](double tolerance) {
    return !is_too_large(job_size(shapes, formats, part, tolerance, operations));
  };
  if (!does(kCoarsest_mm)) return 0.0;
  const double finest = sides_of_change([&](double tolerance) { return does(std::exp(tolerance)); },
                                        std::log(kCoarsest_mm), std::log(tolerance_mm), 40)
                            .first;
  const double tolerance_um = um_from_mm(std::exp(finest));
  const double digit = std::pow(10.0, std::floor(std::log10(tolerance_um)) - 1.0);
  double rounded_um = std::ceil(tolerance_um / digit - 1e-9) * digit;
  while (rounded_um < um_from_mm(kCoarsest_mm) && !does(mm_from_um(rounded_um))) rounded_um += digit;
  return rounded_um;
}

}  // namespace

JobSize job_size(const PartShapes& shapes, const std::vector<io::FileFormat>& formats,
                 const std::string& part, double tolerance_mm, double operations) {
  double bytes_a_facet = 0.0;
  for (const io::FileFormat format : formats) bytes_a_facet += bytes_of_facet(format);
  if (bytes_a_facet == 0.0) return {};
  JobSize size;
  std::vector<double> facets(shapes.parts.size(), 0.0);
  for (std::size_t i = 0; i < shapes.parts.size(); ++i)
    if (part.empty() || shapes.parts[i].name == part) {
      facets[i] = estimated_facets(shapes.parts[i], tolerance_mm);
      size.facets += facets[i];
      if (is_displaced(shapes.parts[i]))
        size.correcting_s += facets[i] * kDisplacementsOfFacet * operations / kOperationsOfSecond;
    }
  double written = size.facets;
  if (part.empty() && shapes.assembly.size() > 1)
    for (const Placement& body : shapes.assembly)
      written += facets[static_cast<std::size_t>(body.part)];
  size.file_bytes = written * bytes_a_facet;
  size.memory_bytes = size.facets * kMemoryOfFacet_bytes;
  return size;
}

Errors job_size_errors(const PartShapes& shapes, const std::vector<io::FileFormat>& formats,
                       const std::string& part, double tolerance_mm, double operations) {
  const JobSize size = job_size(shapes, formats, part, tolerance_mm, operations);
  if (!is_too_large(size)) return {};
  const double would_do_um = tolerance_that_would_do_um(shapes, formats, part, tolerance_mm, operations);
  const auto gigabytes = [](double bytes) { return printed_number(1e-9 * bytes, "%.2g") + " GB"; };
  const auto minutes = [](double seconds) {
    return printed_number(seconds / 60.0, "%.3g") + " minutes";
  };
  return {
      {.code = ErrorCode::kInfeasible,
       .message = "these meshes would have about " + count_text(size.facets) + " facets, " +
                  gigabytes(size.memory_bytes) + " of memory and " + gigabytes(size.file_bytes) +
                  " of files; " + count_text(kMostFacets) + " facets and " +
                  gigabytes(kMostFileBytes) + " of files are the most" +
                  (size.correcting_s > 0.0
                       ? "; what the correction bends into them takes about " +
                             minutes(size.correcting_s) + ", and " + minutes(kMostCorrecting_s) +
                             " are the most"
                       : ""),
       .key = "--tolerance-um",
       .value = printed_number(um_from_mm(tolerance_mm), "%.6g"),
       .remedy =
           would_do_um > 0.0
               ? printed_number(would_do_um, "%.3g") + " or more; or one --part, or fewer formats"
               : operations > 0.0
                     ? "smoother effects, or fewer: no tolerance makes these meshes small enough"
                     : "fewer teeth or less face width: no tolerance makes these meshes small enough"}};
}

}  // namespace trueflank
