// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace trueflank::test {

/// Clearances of the first mesh of random designs (clearance_figures_test.cpp): by number of the design that of the
/// teeth centred, of gear 2 turned on, and driving, in micrometres, and the least of a mesh cycle.
inline constexpr const char* kRecordedClearances = R"(
1: 0.000 -24.470 none sweep 0.000, tips 0.000, driving 0.000
2: 67.382 15.734 -8.044 sweep 67.382, tips 67.382, driving -8.044
3: 29.659 -30.481 0.000 sweep 29.659, tips 29.659, driving 0.000
4: -81.200 -109.205 -133.857 sweep -81.200, tips -81.200, driving -133.857
5: -5.136 -19.231 none sweep -5.136, tips -5.136, driving -5.136
6: 87.515 35.832 0.000 sweep 87.515, tips 87.515, driving 0.000
7: 13.396 13.396 0.000 sweep 13.396, tips 13.396, driving 0.000
8: 0.000 -21.613 none sweep 0.000, tips 0.000, driving 0.000
9: 30.333 7.780 0.000 sweep 30.333, tips 30.333, driving 0.000
10: 16.474 5.343 -0.008 sweep 16.474, tips 16.474, driving -0.008
11: 7.427 -39.445 -0.035 sweep 7.427, tips 7.427, driving -0.035
12: 71.049 22.185 0.000 sweep 71.049, tips 71.049, driving 0.000
13: -17.219 -81.902 none sweep -17.219, tips -17.219, driving -17.219
14: 39.111 10.920 0.000 sweep 39.111, tips 39.111, driving 0.000
15: 71.703 39.754 0.000 sweep 71.703, tips 71.703, driving 0.000
16: 0.000 -31.010 none sweep 0.000, tips 0.000, driving 0.000
17: 0.000 -36.648 none sweep 0.000, tips 0.000, driving 0.000
18: 0.000 -22.553 none sweep 0.000, tips 0.000, driving 0.000
19: 6.906 -68.269 0.000 sweep 6.906, tips 6.906, driving 0.000
20: -82.764 -91.053 -103.592 sweep -82.764, tips -82.764, driving -103.592
21: 0.000 -47.924 none sweep 0.000, tips 0.000, driving 0.000
22: 4.360 -44.504 0.000 sweep 4.360, tips 4.360, driving 0.000
23: 67.250 54.315 0.000 sweep 67.250, tips 67.250, driving 0.000
24: 93.079 48.914 0.000 sweep 93.079, tips 93.079, driving 0.000
25: 83.050 61.751 0.000 sweep 83.050, tips 83.050, driving 0.000
26: -51.611 -78.064 none sweep -51.611, tips -51.611, driving -51.611
27: 0.000 -15.975 none sweep 0.000, tips 0.000, driving 0.000
28: 49.099 37.462 -13.564 sweep 49.099, tips 49.099, driving -13.564
29: 7.739 -41.125 0.000 sweep 7.739, tips 7.739, driving 0.000
31: 25.044 -14.468 -36.602 sweep 25.044, tips 25.044, driving -36.602
32: 72.464 55.550 0.000 sweep 72.464, tips 72.464, driving 0.000
34: 53.278 -2.875 0.000 sweep 53.278, tips 53.278, driving 0.000
35: 14.097 -15.973 0.000 sweep 14.097, tips 14.097, driving 0.000
36: 0.000 -15.035 none sweep 0.000, tips 0.000, driving 0.000
37: 52.365 -5.896 0.000 sweep 52.365, tips 52.365, driving 0.000
38: 0.000 -42.286 none sweep 0.000, tips 0.000, driving 0.000
39: 12.400 -46.728 0.000 sweep 12.400, tips 12.400, driving 0.000
40: 34.409 19.627 0.000 sweep 34.409, tips 34.409, driving 0.000
41: -34.659 -71.025 -53.450 sweep -34.659, tips -34.659, driving -53.450
42: 26.797 -23.750 0.000 sweep 26.797, tips 26.797, driving 0.000
43: 50.883 33.968 0.000 sweep 50.883, tips 50.883, driving 0.000
)";

/// Of teeth with modified flanks: centred and driving with their heights, the smallest clearance alone, the heights
/// that decide, and of rings at how many rotations the pinion leaves them.
inline constexpr const char* kRecordedModifiedClearances = R"(
0: 0.000 at 5.000, driving none at none, alone 0.000, 5.000
1: 2.620 at 0.000, driving -0.015 at 0.000, alone 2.620, 0.000 2.500 5.000 7.500 10.000
2: -11.142 at 3.000, driving -26.747 at 3.000, alone -11.142, 0.000 2.500 3.000 5.000 7.000 7.500 10.000, free at 64
3: 28.034 at none, driving 0.000 at none, alone 28.034, none
4: -0.400 at 4.000, driving none at none, alone -0.400, 0.000 2.500 4.000 5.000 6.000 7.500 10.000
5: -5.208 at 0.000, driving none at none, alone -5.208, 0.000 2.500 5.000 7.500 10.000, free at 64
6: 18.794 at 5.000, driving 0.000 at 5.000, alone 18.794, 5.000
7: 23.871 at 0.000, driving 0.000 at 0.000, alone 23.871, 0.000 2.500 5.000 7.500 10.000
)";

}  // namespace trueflank::test
