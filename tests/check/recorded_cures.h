// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace trueflank::test {

/// What joint cures change of random designs (joint_cure_figures_test.cpp): by number of the design the keys as the
/// file writes them, what contradicts what where none is found, and whether the search ended.
inline constexpr const char* kRecordedCures = R"(
1: wheel.tip_diameter_mm 28.841
6: pinion.shift -0.1764; gearbox.tips none; (not ended)
11: gearbox.tips none
46: pinion.tip_diameter_mm 66.608; wheel.tip_diameter_mm 112.916
58: pinion.tip_diameter_mm 46.423; gearbox.tips none; (not ended)
74: pinion.tip_diameter_mm 54.012; wheel.tip_diameter_mm 147.96; (not ended)
92: wheel.shift none
100: gearbox.centre_distance_mm 14.6388; pinion.shift 0.3113; wheel.shift none
109: pinion.shift -0.2585; gearbox.tips none; wheel.shift none
127: gearbox.planets 2
150: gearbox.backlash_mm 0.0224; pinion.tip_diameter_mm 57.726; wheel.tip_diameter_mm 134.959
154: gearbox.tips none
165: gearbox.planets 2
177: wheel.shift none
183: wheel.tip_diameter_mm 66.597
206: gearbox.backlash_mm 0.0435; wheel.tip_diameter_mm 82.526; (not ended)
209: gearbox.tips none; wheel.shift none
218: gearbox.centre_distance_mm 22.168301; pinion.shift 0.2289; pinion.tip_diameter_mm 18.866; gearbox.tips none; wheel.shift none; (not ended)
230: wheel.shift none; (not ended)
262: gearbox.backlash_mm 0.0683; wheel.tip_diameter_mm 112.315; wheel.shift none
267: wheel.shift none
280: gearbox.tips none
305: gearbox.tips none
307: wheel.tip_diameter_mm 119.623; (not ended)
311: gearbox.backlash_mm 0.0433
318: gearbox.backlash_mm 0.0132
322: wheel.shift none
330: pinion.shift 0.2694; pinion.tip_diameter_mm 21.077; gearbox.tips none; wheel.shift none; (not ended)
351: gearbox.tips none; (not ended)
357: pinion.tip_diameter_mm 42.508
374: gearbox.backlash_mm 0.0644; wheel.shift none
403: pinion.shift 0.794; wheel.shift none
414: gearbox.tips none; wheel.shift none
440: gearbox.planets 2
452: gearbox.centre_distance_mm 22.9531; pinion.shift 0.8201; wheel.shift none
468: wheel.tip_diameter_mm 75.152
)";

/// Of designs that take longer.
inline constexpr const char* kRecordedLongerCures = R"(
15: pinion.shift -0.0301; pinion.tip_diameter_mm 27.165; wheel.tip_diameter_mm 71.36; wheel.shift none; (not ended)
19: gearbox.backlash_mm 0.0523
44: pinion.teeth 8; pinion.shift 0.2976; pinion.tip_diameter_mm 10.162; gearbox.tips none; wheel.shift none; (not ended)
50: gearbox.centre_distance_mm 49.207582; pinion.shift 0.2371; pinion.tip_diameter_mm 62.914; gearbox.tips none; wheel.shift none; (not ended)
59: wheel.shift none; (not ended)
86: gearbox.centre_distance_mm 23.96256; wheel.tip_diameter_mm 58.78; (not ended)
290: gearbox.centre_distance_mm 46.178285; gearbox.backlash_mm 0.0439; pinion.shift -0.2242; wheel.tip_diameter_mm 69.558; wheel.shift none; (not ended)
294: gearbox.centre_distance_mm 86.226164; pinion.shift -0.2678; wheel.tip_diameter_mm 90.037; gearbox.tips none; (not ended)
298: pinion.shift 0.1299; pinion.tip_diameter_mm 43.023; wheel.shift none; (not ended)
342: gearbox.centre_distance_mm 99.125433; pinion.shift 0.3368; pinion.tip_diameter_mm 79.504; wheel.shift none; (not ended)
419: gearbox.centre_distance_mm 47.9363; pinion.shift 0.5911; pinion.tip_diameter_mm 92.965; wheel.shift none; (not ended)
427: gearbox.centre_distance_mm 52.5306; pinion.shift 0.1482; gearbox.tips none; wheel.shift none; (not ended)
471: gearbox.centre_distance_mm 34.6213; pinion.shift 0.3307; wheel.tip_diameter_mm 56.397; wheel.shift none; (not ended)
477: gearbox.centre_distance_mm 21.4745; pinion.shift -0.2735; wheel.tip_diameter_mm 16.508; wheel.shift none
487: pinion.shift 0.2843; gearbox.tips none; (not ended)
499: gearbox.centre_distance_mm 18.4053; pinion.shift 0.2878; wheel.shift none; nothing near this design clears contact_ratio(not ended)
)";

}  // namespace trueflank::test
