// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "trueflank/loop/measured/measurement.h"

// One reader a kind of file; read_measured_files() chooses. Each takes the file's text, adds
// sentences on what it left out to notes, and fails only where nothing usable is left.
namespace trueflank::loop {

[[nodiscard]] Result<ScanData> read_scan_csv(const std::string& file, std::string_view text,
                                             std::vector<std::string>& notes);
[[nodiscard]] Result<ScanData> read_xyz(const std::string& file, std::string_view text,
                                        std::vector<std::string>& notes);
/// Every mesh format of export/mesh_reader.h; damaged files for what they hold.
[[nodiscard]] Result<ScanData> read_scan_mesh(const std::string& file, std::string_view text,
                                              std::vector<std::string>& notes);
[[nodiscard]] Result<InspectionData> read_inspection_csv(const std::string& file,
                                                         std::string_view text,
                                                         std::vector<std::string>& notes);
[[nodiscard]] Result<SizeData> read_sizes_csv(const std::string& file, std::string_view text,
                                              std::vector<std::string>& notes);
/// Klingelnberg MKA. Limits: written against a published parser, not against files (docs/loop.md).
[[nodiscard]] Result<InspectionData> read_mka(const std::string& file, std::string_view text,
                                              std::vector<std::string>& notes);
/// GDE (VDI/VDE 2610), tolerantly: leaf elements by local name. No conformance is claimed.
[[nodiscard]] Result<InspectionData> read_gde(const std::string& file, std::string_view text,
                                              std::vector<std::string>& notes);

}  // namespace trueflank::loop
