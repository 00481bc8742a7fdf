// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace trueflank::test {

/// Clearances of the first mesh of random designs (clearance_figures_test.cpp): by number of the design that of the
/// teeth centred, of gear 2 turned on, and driving, in micrometres, and the least of a mesh cycle.
inline constexpr const char* kRecordedClearances = R"(
1: 0.000 -24.470 none sweep 0.000
2: 67.382 15.734 -8.044 sweep 67.382
3: 29.659 -30.481 0.000 sweep 29.659
4: -81.200 -109.205 -133.857 sweep -81.200
5: -5.136 -19.231 none sweep -5.136
6: 87.515 35.832 0.000 sweep 87.515
7: 13.396 13.396 0.000 sweep 13.396
8: 0.000 -21.613 none sweep 0.000
9: 30.333 7.780 0.000 sweep 30.333
10: 16.474 5.343 -0.008 sweep 16.474
11: 7.427 -39.445 -0.035 sweep 7.427
12: 71.049 22.185 0.000 sweep 71.049
13: -17.219 -81.902 none sweep -17.219
14: 39.111 10.920 0.000 sweep 39.111
15: 71.703 39.754 0.000 sweep 71.703
16: 0.000 -31.010 none sweep 0.000
17: 0.000 -36.648 none sweep 0.000
18: 0.000 -22.553 none sweep 0.000
19: 6.906 -68.269 0.000 sweep 6.906
20: -82.764 -91.053 -103.592 sweep -82.764
21: 0.000 -47.924 none sweep 0.000
22: 4.360 -44.504 0.000 sweep 4.360
23: 67.250 54.315 0.000 sweep 67.250
24: 93.079 48.914 0.000 sweep 93.079
25: 83.050 61.751 0.000 sweep 83.050
26: -51.611 -78.064 none sweep -51.611
27: 0.000 -15.975 none sweep 0.000
28: 49.099 37.462 -13.564 sweep 49.099
29: 7.739 -41.125 0.000 sweep 7.739
31: 25.044 -14.468 -36.602 sweep 25.044
32: 72.464 55.550 0.000 sweep 72.464
34: 53.278 -2.875 0.000 sweep 53.278
35: 14.097 -15.973 0.000 sweep 14.097
36: 0.000 -15.035 none sweep 0.000
37: 52.365 -5.896 0.000 sweep 52.365
38: 0.000 -42.286 none sweep 0.000
39: 12.400 -46.728 0.000 sweep 12.400
40: 34.409 19.627 0.000 sweep 34.409
41: -34.659 -71.025 -53.450 sweep -34.659
42: 26.797 -23.750 0.000 sweep 26.797
43: 50.883 33.968 0.000 sweep 50.883
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
