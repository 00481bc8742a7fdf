// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace trueflank::test {

/// Rows, columns and nets of random toothings (mesh_figures_test.cpp), by number: of one tooth where teeth are alike.
/// "at": means over the vertices of radius, height and sine of the angle.
inline constexpr const char* kRecordedNets = R"(
0: 41 columns, 2 rows, 590 facets, 254 inside, 0 rising, at 2.226337 1.601835 -0.440205, 0.9085 um
1: 60 columns, 3 rows, 0 facets, 0 inside, 182 rising, at 1.471574 2.448908 0.000000, 0.8627 um
3: 57 columns, 8 rows, 0 facets, 0 inside, 199 rising, at 12.353071 4.731277 0.013928, 1.3509 um
5: 24 columns, 4 rows, 112 facets, 0 inside, 0 rising, at 55.071995 3.853525 -0.000000, 20.6706 um
6: 19 columns, 2 rows, 118 facets, 40 inside, 0 rising, at 45.983042 10.483039 0.106809, 21.3211 um
9: 84 columns, 4 rows, 792 facets, 247 inside, 0 rising, at 16.815774 2.805503 0.100327, 0.9586 um
11: 20 columns, 6 rows, 0 facets, 0 inside, 84 rising, at 7.835498 2.220542 -0.052304, 6.4110 um
12: 18 columns, 2 rows, 76 facets, 20 inside, 0 rising, at 8.668334 1.142182 -0.059206, 2.9300 um
13: 31 columns, 3 rows, 396 facets, 136 inside, 0 rising, at 50.539449 3.393363 -0.024255, 2.1550 um
15: 69 columns, 7 rows, 0 facets, 0 inside, 198 rising, at 11.719288 5.469764 -0.006035, 2.9602 um
18: 48 columns, 3 rows, 728 facets, 268 inside, 0 rising, at 11.138655 4.835011 -0.079771, 1.0794 um
19: 83 columns, 50 rows, 0 facets, 0 inside, 1909 rising, at 75.429611 12.437953 -0.041857, 0.4935 um
21: 30 columns, 4 rows, 108 facets, 0 inside, 0 rising, at 6.915828 2.644955 -0.031918, 8.5674 um
24: 81 columns, 3 rows, 2284 facets, 980 inside, 0 rising, at 44.162931 9.193811 -0.045411, 0.2405 um
30: 40 columns, 2 rows, 126 facets, 23 inside, 0 rising, at 8.510078 2.570432 -0.018751, 1.0283 um
31: 43 columns, 4 rows, 0 facets, 0 inside, 62 rising, at 40.266599 3.052273 -0.001426, 0.6305 um
33: 28 columns, 5 rows, 160 facets, 12 inside, 0 rising, at 5.078385 3.083056 0.032542, 9.3088 um
36: 14 columns, 2 rows, 44 facets, 8 inside, 0 rising, at 89.305397 7.404330 0.035506, 34.4924 um
42: 18 columns, 3 rows, 104 facets, 16 inside, 0 rising, at 10.604802 7.979217 0.098150, 39.7738 um
43: 21 columns, 3 rows, 0 facets, 0 inside, 42 rising, at 6.102992 1.326928 0.000004, 2.1544 um
45: 26 columns, 4 rows, 136 facets, 20 inside, 0 rising, at 84.660679 19.786138 -0.065570, 33.5991 um
47: 51 columns, 9 rows, 0 facets, 0 inside, 261 rising, at 174.444493 8.626845 -0.000779, 3.3185 um
48: 49 columns, 3 rows, 468 facets, 136 inside, 0 rising, at 28.612490 3.984681 0.016493, 1.0145 um
49: 40 columns, 2 rows, 556 facets, 238 inside, 0 rising, at 18.781264 3.921960 -0.076351, 0.5862 um
50: 25 columns, 3 rows, 0 facets, 0 inside, 1612 rising, at 12.299321 2.275480 -0.000031, 2.1198 um
51: 20 columns, 5 rows, 0 facets, 0 inside, 18 rising, at 99.540277 10.719288 0.030943, 31.0542 um
53: 20 columns, 4 rows, 84 facets, 0 inside, 0 rising, at 15.313149 2.256863 -0.023254, 16.8924 um
54: 109 columns, 9 rows, 0 facets, 0 inside, 436 rising, at 49.855993 14.226777 0.002801, 0.7862 um
55: 20 columns, 3 rows, 0 facets, 0 inside, 405 rising, at 5.628929 0.623846 0.000000, 5.3077 um
56: 27 columns, 9 rows, 0 facets, 0 inside, 1298 rising, at 5.433972 3.774074 -0.000087, 4.4275 um
58: 16 columns, 4 rows, 0 facets, 0 inside, 1292 rising, at 10.676850 2.056738 -0.000052, 4.6168 um
60: 45 columns, 2 rows, 174 facets, 42 inside, 0 rising, at 7.617541 1.080169 -0.026452, 0.3989 um
61: 23 columns, 2 rows, 44 facets, 0 inside, 0 rising, at 29.250455 9.011159 -0.017237, 12.0319 um
66: 45 columns, 3 rows, 0 facets, 0 inside, 45 rising, at 10.871598 1.722425 0.001909, 0.5446 um
67: 36 columns, 6 rows, 0 facets, 0 inside, 160 rising, at 104.319599 12.955889 -0.053250, 6.4556 um
69: 69 columns, 4 rows, 270 facets, 22 inside, 0 rising, at 56.530083 2.930499 0.024334, 3.5568 um
71: 22 columns, 5 rows, 0 facets, 0 inside, 30 rising, at 10.281633 2.390889 0.024102, 4.6604 um
73: 56 columns, 2 rows, 344 facets, 116 inside, 0 rising, at 118.495579 16.166814 0.020657, 1.4652 um
74: 35 columns, 10 rows, 0 facets, 0 inside, 6169 rising, at 17.383533 8.216622 -0.000045, 2.8349 um
75: 27 columns, 11 rows, 0 facets, 0 inside, 135 rising, at 152.215729 14.999205 0.029414, 11.3462 um
77: 43 columns, 4 rows, 278 facets, 54 inside, 0 rising, at 7.474668 1.676140 -0.098641, 2.2783 um
79: 95 columns, 3 rows, 0 facets, 0 inside, 190 rising, at 11.461823 0.974031 -0.000490, 0.0270 um
81: 54 columns, 4 rows, 262 facets, 39 inside, 0 rising, at 37.637927 5.273034 0.099722, 13.8240 um
83: 17 columns, 10 rows, 0 facets, 0 inside, 476 rising, at 3.699063 1.921431 -0.000006, 12.5375 um
85: 41 columns, 2 rows, 210 facets, 64 inside, 0 rising, at 52.246664 8.033977 0.000000, 5.0004 um
86: 23 columns, 11 rows, 0 facets, 0 inside, 11012 rising, at 118.982153 18.444373 -0.000017, 10.6039 um
87: 35 columns, 6 rows, 0 facets, 0 inside, 68 rising, at 29.573590 11.183973 0.048093, 7.7102 um
91: 54 columns, 6 rows, 0 facets, 0 inside, 36 rising, at 52.210663 5.258123 0.014857, 0.5302 um
92: 18 columns, 4 rows, 0 facets, 0 inside, 3168 rising, at 51.757655 3.996354 -0.000018, 3.8912 um
93: 39 columns, 5 rows, 184 facets, 0 inside, 0 rising, at 5.726807 2.294165 0.002372, 3.8453 um
97: 27 columns, 4 rows, 0 facets, 0 inside, 2475 rising, at 41.827291 4.574033 0.000000, 5.5514 um
103: 51 columns, 3 rows, 0 facets, 0 inside, 102 rising, at 16.571753 2.843176 -0.019064, 1.3503 um
111: 22 columns, 6 rows, 0 facets, 0 inside, 16 rising, at 27.846224 3.008526 0.064821, 8.6185 um
115: 24 columns, 6 rows, 0 facets, 0 inside, 448 rising, at 13.923694 10.041205 -0.000000, 21.6071 um
117: 41 columns, 5 rows, 168 facets, 0 inside, 0 rising, at 1.205285 1.084785 0.021448, 3.5384 um
121: 52 columns, 2 rows, 104 facets, 0 inside, 0 rising, at 10.705577 1.480007 -0.000003, 0.3350 um
122: 15 columns, 3 rows, 0 facets, 0 inside, 330 rising, at 28.701250 4.346606 -0.000075, 29.4729 um
123: 27 columns, 10 rows, 0 facets, 0 inside, 18 rising, at 12.466685 1.985064 0.119860, 3.0043 um
127: 64 columns, 3 rows, 0 facets, 0 inside, 128 rising, at 4.712878 2.122575 0.000166, 0.4509 um
128: 40 columns, 3 rows, 0 facets, 0 inside, 167 rising, at 22.398282 6.386245 -0.000070, 5.8308 um
129: 179 columns, 4 rows, 626 facets, 26 inside, 0 rising, at 1.950872 0.782571 0.025564, 0.2790 um
133: 20 columns, 2 rows, 0 facets, 0 inside, 400 rising, at 28.619422 7.115555 -0.000003, 7.0680 um
139: 100 columns, 20 rows, 0 facets, 0 inside, 1900 rising, at 12.576523 0.991866 -0.037882, 0.0637 um
141: 24 columns, 5 rows, 108 facets, 0 inside, 0 rising, at 8.407160 2.677316 0.004528, 8.5517 um
143: 24 columns, 5 rows, 0 facets, 0 inside, 20 rising, at 43.914621 4.198397 0.016675, 9.2413 um
145: 21 columns, 2 rows, 246 facets, 102 inside, 0 rising, at 67.607593 19.026017 -0.243528, 28.0586 um
147: 14 columns, 5 rows, 0 facets, 0 inside, 24 rising, at 33.483287 6.140654 0.033051, 34.6111 um
151: 14 columns, 4 rows, 0 facets, 0 inside, 18 rising, at 135.746602 8.904259 0.011540, 21.9870 um
153: 143 columns, 4 rows, 490 facets, 18 inside, 0 rising, at 6.247245 1.305148 0.020347, 0.3335 um
155: 76 columns, 8 rows, 0 facets, 0 inside, 372 rising, at 4.122372 3.090345 -0.003405, 0.4779 um
157: 85 columns, 2 rows, 618 facets, 224 inside, 0 rising, at 2.128551 0.867661 -0.081774, 0.1336 um
161: 39 columns, 4 rows, 314 facets, 78 inside, 0 rising, at 3.663661 1.057022 -0.192245, 2.2526 um
165: 84 columns, 4 rows, 536 facets, 124 inside, 0 rising, at 15.119885 1.378655 0.030367, 0.3762 um
166: 23 columns, 4 rows, 0 facets, 0 inside, 399 rising, at 1.620179 0.707858 -0.000229, 4.5340 um
167: 30 columns, 8 rows, 0 facets, 0 inside, 85 rising, at 18.959706 4.692538 0.164089, 12.2349 um
170: 14 columns, 3 rows, 0 facets, 0 inside, 110 rising, at 31.431012 2.955827 -0.000048, 17.1981 um
181: 18 columns, 2 rows, 0 facets, 0 inside, 711 rising, at 92.661921 14.956739 -0.000000, 11.3773 um
183: 33 columns, 8 rows, 0 facets, 0 inside, 132 rising, at 45.876363 10.612865 -0.021155, 7.1828 um
191: 27 columns, 5 rows, 0 facets, 0 inside, 51 rising, at 25.186155 5.106151 0.000003, 11.7498 um
195: 16 columns, 5 rows, 0 facets, 0 inside, 50 rising, at 15.897876 1.239381 -0.019266, 3.7130 um
197: 48 columns, 5 rows, 264 facets, 28 inside, 0 rising, at 100.700816 17.452241 0.010494, 12.6227 um
206: 60 columns, 5 rows, 0 facets, 0 inside, 88 rising, at 36.576811 11.432761 -0.000078, 2.9690 um
207: 31 columns, 10 rows, 0 facets, 0 inside, 28 rising, at 11.615609 1.557872 0.060519, 0.6389 um
209: 44 columns, 4 rows, 156 facets, 0 inside, 0 rising, at 37.623007 5.405637 0.000044, 2.8736 um
212: 14 columns, 2 rows, 0 facets, 0 inside, 251 rising, at 5.670722 0.778820 -0.000108, 5.5004 um
215: 39 columns, 5 rows, 0 facets, 0 inside, 118 rising, at 46.780906 8.030869 -0.000039, 3.4044 um
231: 49 columns, 12 rows, 0 facets, 0 inside, 287 rising, at 22.468408 11.732830 0.058822, 6.5464 um
236: 10 columns, 3 rows, 0 facets, 0 inside, 1420 rising, at 50.532800 4.182499 -0.000024, 15.0776 um
238: 63 columns, 4 rows, 0 facets, 0 inside, 813 rising, at 4.368443 2.615670 -0.000346, 4.7007 um
242: 11 columns, 5 rows, 0 facets, 0 inside, 1056 rising, at 12.424151 1.294687 -0.000022, 4.3684 um
275: 15 columns, 5 rows, 0 facets, 0 inside, 45 rising, at 50.743174 5.099458 -0.002663, 12.0923 um
287: 24 columns, 5 rows, 0 facets, 0 inside, 1462 rising, at 68.211142 8.090666 -0.000000, 18.9324 um
293: 108 columns, 4 rows, 268 facets, 0 inside, 0 rising, at 13.111585 4.224092 -0.000022, 0.6555 um
)";

}  // namespace trueflank::test
