// ------------------------------------------------------------------ curves of a half tooth
// A curve is [kind, from, to, ...]: mm, degrees. A tooth's half runs from the middle of its tip
// (on +x) to the middle of the gap, counter-clockwise about the gear's axis.
function direction(a) = [cos(a), sin(a)];
function turned(p, a) = [cos(a)*p[0] - sin(a)*p[1], sin(a)*p[0] + cos(a)*p[1]];
function mirrored(p) = [p[0], -p[1]];

// involute of the circle of radius rb; t: roll angle
function involute_point(t, rb, half_angle, sense) =
  rb*(direction(half_angle + sense*t) - sense*t*PI/180*direction(half_angle + sense*t + 90));
// root fillet cut by the rounded corner of a rack; t: angle of the corner's normal
function rack_point(t, rp, depth, offset, radius, stretch, gap) =
  let (d = depth + radius*sin(t),
       side = d*cos(t)/(stretch*sin(t)),
       travel = offset + stretch*radius*cos(t) - side)
  turned([rp - d, -side], gap - travel/rp*180/PI);
// root fillet cut, or tip trimmed, by the rounded corner of a pinion cutter
function cutter_point(t, distance, rp, rc, corner_angle, radius, ratio, gap, trims) =
  let (swing = asin(max(-1, min(1, rc/rp*sin(t - corner_angle)))),
       turn = trims ? t - 180 + swing : t - swing)
  turned([distance, 0] + rc*direction(turn - corner_angle) + radius*direction(turn - t),
         gap - turn*ratio);

function curve_point(c, t) =
  c[0] == "arc"      ? [c[3], c[4]] + c[5]*direction(t) :
  c[0] == "line"     ? [c[3], c[4]] + t*[c[5], c[6]] :
  c[0] == "involute" ? involute_point(t, c[3], c[4], c[5]) :
  c[0] == "rack"     ? rack_point(t, c[3], c[4], c[5], c[6], c[7], c[8]) :
                       cutter_point(t, c[3], c[4], c[5], c[6], c[7], c[8], c[9], c[10]);

function chord_height(c, a, b) =
  let (p = curve_point(c, a), d = curve_point(c, b) - p, m = curve_point(c, (a + b)/2) - p)
  norm(d) == 0 ? 0 : abs(d[0]*m[1] - d[1]*m[0])/norm(d);
// chords that keep the tolerance: a chord's height falls with the square of their number
function chords(c, tolerance) = c[0] == "line" ? 1 :
  let (step = (c[2] - c[1])/16,
       highest = max([for (i = [0:15]) chord_height(c, c[1] + i*step, c[1] + (i + 1)*step)]))
  max(1, ceil(16*1.06*sqrt(highest/tolerance)));

function about_axis(c) = c[0] == "arc" && c[3] == 0 && c[4] == 0;
// thinner by the angle `slack`: flank and fillet turn towards the tooth's middle, tip and root arc follow
function thinned_point(c, t, slack) =
  about_axis(c) ? curve_point(c, t) : turned(curve_point(c, t), -slack);
function half_tooth(curves, tolerance, slack) =
  let (last = len(curves) - 1)
  [for (i = [0:last])
     let (c = curves[i], n = chords(c, tolerance),
          from = c[1] - (i == last && about_axis(c) ? slack : 0),
          to = c[2] - (i == 0 && about_axis(c) ? slack : 0))
     for (j = [i == 0 ? 0 : 1:n]) thinned_point(c, from + (to - from)*j/n, slack)];
// one tooth, from gap to gap
function tooth(curves, tolerance, slack) =
  assert(slack == 0 || about_axis(curves[0]), "a pointed tooth cannot be thinned here")
  let (half = half_tooth(curves, tolerance, slack), n = len(half),
       closes = slack == 0 || about_axis(curves[len(curves) - 1]))
  concat([for (j = [n - 1:-1:1]) mirrored(half[j])], [for (j = [0:n - 2]) half[j]],
         closes ? [] : [half[n - 1]]);

// ------------------------------------------------------------------ modified flanks
// m: [first, last curve of the flank, turns over the roll angle of the counter-clockwise flank, of the
// clockwise one, shares of the fade at the fillets' ends]; degrees towards the flank's own side. h, at a height: [turns of the two, depth of an
// edge chamfer]. Fillets fade to their undeviated end, the tip's land goes with the flank.
// a point that ends on the circle of the roll angle t started on the flank's normal, a deviation away
function deviation_turn(m, h, side, t, sense, steps) =
  lookup(steps == 0 ? t : t + sense*deviation_turn(m, h, side, t, sense, steps - 1), m[2 + side]) + h[side];
function flank_turn(curves, m, h, side, t) =
  let (c = curves[m[0]]) deviation_turn(m, h, side, t, c[5], 4) - h[2]/c[3]*180/PI;
function lowered_tip(c, depth) =
  let (r = norm(curve_point(c, c[1])) + c[5]*depth) sqrt(max(0, r*r/(c[3]*c[3]) - 1))*180/PI;
// the flank ends lower where an edge chamfer takes the tip's corner
function flank_roll(curves, m, h, t) =
  h[2] == 0 || m[0] != 1 ? t :
  let (tip = curves[m[0]][1], root = curves[m[1]][2])
  root + (t - root)*(lowered_tip(curves[m[0]], h[2]) - root)/(tip - root);
function modified_point(curves, m, h, side, slack, i, share) =
  let (c = curves[i], t = c[1] + (c[2] - c[1])*share, flank = curves[m[0]])
  i > m[1] + len(m[4])
    ? let (from = c[1] - (about_axis(c) ? slack : 0))
      thinned_point(c, from + (c[2] - from)*share, slack) :
  i > m[1]
    ? let (ends = m[4][i - m[1] - 1], s = ends[0] + (ends[1] - ends[0])*share, fade = 1 - s*s*(3 - 2*s))
      turned(curve_point(c, t), flank_turn(curves, m, h, side, curves[m[1]][2])*fade - slack) :
  i >= m[0]
    ? let (roll = flank_roll(curves, m, h, t))
      turned(curve_point(c, roll), flank_turn(curves, m, h, side, roll) - slack) :
  let (tip = flank_roll(curves, m, h, flank[1]), turn = flank_turn(curves, m, h, side, tip) - slack)
  !about_axis(c) ? turned(curve_point(c, t), turn) :
  let (corner = m[0] == 1 ? curve_point(flank, tip) : curve_point(c, c[2]))
  norm(corner)*direction(share*(atan2(corner[1], corner[0]) + turn));
function modified_height(curves, m, h, side, i, a, b) =
  let (p = modified_point(curves, m, h, side, 0, i, a), d = modified_point(curves, m, h, side, 0, i, b) - p,
       q = modified_point(curves, m, h, side, 0, i, (a + b)/2) - p)
  norm(d) == 0 ? 0 : abs(d[0]*q[1] - d[1]*q[0])/norm(d);
// chords of every curve, enough at all the heights
function modified_chords(curves, m, heights, tolerance) =
  [for (i = [0:len(curves) - 1])
     let (highest = max([for (h = heights) for (side = [0, 1]) for (k = [0:15])
                           modified_height(curves, m, h, side, i, k/16, (k + 1)/16)]))
     max(1, ceil(16*1.06*sqrt(highest/tolerance)))];
function modified_half(curves, m, h, side, counts, slack) =
  [for (i = [0:len(curves) - 1]) for (j = [i == 0 ? 0 : 1:counts[i]])
     modified_point(curves, m, h, side, slack, i, j/counts[i])];
function modified_outline(curves, m, h, counts, teeth, rotation, slack) =
  assert(slack == 0 || about_axis(curves[0]), "a pointed tooth cannot be thinned here")
  let (left = modified_half(curves, m, h, 0, counts, slack), right = modified_half(curves, m, h, 1, counts, slack),
       n = len(left), closes = slack == 0 || about_axis(curves[len(curves) - 1]),
       one = concat([for (j = [n - 1:-1:1]) mirrored(right[j])], [for (j = [0:n - 2]) left[j]],
                    closes ? [] : [left[n - 1]]))
  [for (k = [0:teeth - 1]) for (p = one) turned(p, rotation + 360*k/teeth)];
// f: over the share of a slab's height [turns of the two flanks, chamfer's depth, where they bend]
function face_at(f, u) = [lookup(u, f[0]), lookup(u, f[1]), lookup(u, f[2])];
function faces(f) = [for (u = f[3]) face_at(f, u)];
function face_bulge(f, a, b) =
  max([for (k = [0:15]) for (side = [0, 1])
         let (p = a + (b - a)*k/16, q = p + (b - a)/16)
         abs(lookup((p + q)/2, f[side]) - (lookup(p, f[side]) + lookup(q, f[side]))/2)]);
function face_rows(f, a, b, height, rate, radius, tolerance) =
  let (twist = abs(rate)*height*(b - a)/(2*acos(max(0, 1 - tolerance/radius))),
       face = 16*1.06*sqrt(face_bulge(f, a, b)*PI/180*radius/tolerance),
       chamfer = lookup(a, f[2]) == lookup(b, f[2]) ? 0 : 2)
  max(1, ceil(sqrt(twist*twist + face*face + chamfer*chamfer)));
// rows of a slab whose section changes: [share of the height, turn, outline]
function modified_rows(height, start, rate, apex, radius, tolerance, curves, m, f, counts, teeth, rotation, slack) =
  [for (i = [0:len(f[3]) - 2])
     let (a = f[3][i], b = f[3][i + 1], n = face_rows(f, a, b, height, rate, radius, tolerance))
     for (k = [i == 0 ? 0 : 1:n])
       let (u = a + (b - a)*k/n, turn = start + rate*height*(u <= apex ? u : 2*apex - u))
       [u, turn, modified_outline(curves, m, face_at(f, u), counts, teeth, rotation + turn, slack)]];

// ------------------------------------------------------------------ outlines, counter-clockwise
function gear_outline(curves, teeth, rotation, tolerance, slack) =
  let (one = tooth(curves, tolerance, slack))
  [for (k = [0:teeth - 1]) for (p = one) turned(p, rotation + 360*k/teeth)];
function arc_points(r, from, to, tolerance) =
  let (n = max(3, ceil((to - from)/(2*acos(max(0, 1 - tolerance/r))))))
  [for (i = [0:n]) r*direction(from + (to - from)*i/n)];
function circle_outline(d, tolerance, centre = [0, 0]) =
  let (n = max(12, ceil(180/acos(max(0, 1 - 2*tolerance/d)))))
  [for (i = [0:n - 1]) centre + d/2*direction(360*i/n)];
function d_outline(d, flat, tolerance) =
  let (a = acos((flat - d/2)/(d/2))) arc_points(d/2, a, 360 - a, tolerance);
function keyway_outline(d, width, depth, tolerance) =
  let (a = asin(width/d))
  concat(arc_points(d/2, a, 360 - a, tolerance), [[d/2 + depth, -width/2], [d/2 + depth, width/2]]);
function hex_outline(across_flats) =
  [for (i = [0:5]) across_flats/2/cos(30)*direction(60*i - 30)];

// ------------------------------------------------------------------ solids without booleans
function lengths_before(lists, i) = i == 0 ? 0 : lengths_before(lists, i - 1) + len(lists[i - 1]);
module section(outer, holes = []) {
  loops = concat([outer], holes);
  polygon([for (loop = loops) for (p = loop) p],
          [for (i = [0:len(loops) - 1])
             let (first = lengths_before(loops, i)) [for (j = [0:len(loops[i]) - 1]) first + j]]);
}
module prism(height, outer, holes = [])
  linear_extrude(height = height, convexity = 10) section(outer, holes);

function heights_before(slabs, i) = i == 0 ? 0 : heights_before(slabs, i - 1) + slabs[i - 1][0];
function largest_radius(loop) = max([for (p = loop) norm(p)]);
function reversed(list, yes = true) = yes ? [for (i = [len(list) - 1:-1:0]) list[i]] : list;
function wall(lower, upper, n, inwards = false) =
  [for (i = [0:n - 1])
     reversed([lower + i, upper + i, upper + (i + 1)%n, lower + (i + 1)%n], inwards)];
// between two rows of a loop of which the upper is turned: each quadrilateral is cut along the diagonal
// that runs with the turn where the loop bulges, against it where it is hollow
function turned_wall(loop, lower, upper, turn, inwards = false) =
  let (n = len(loop))
  [for (i = [0:n - 1])
     let (j = (i + 1)%n, k = (i + 2)%n, d = loop[j] - loop[i], e = loop[k] - loop[j],
          bulges = d[0]*e[1] - d[1]*e[0] >= 0, rises = (turn < 0) == bulges)
     for (f = rises ? [[lower + i, upper + i, upper + j], [lower + i, upper + j, lower + j]]
                    : [[lower + i, upper + i, lower + j], [upper + i, upper + j, lower + j]])
       reversed(f, inwards)];
function nearest(loop, p) =
  let (off = [for (q = loop) abs(atan2(p[0]*q[1] - p[1]*q[0], p[0]*q[0] + p[1]*q[1]))],
       least = min(off))
  [for (i = [0:len(off) - 1]) if (off[i] == least) i][0];
// the ring between two loops, a polygon for every `step` points of the outer one
function annulus(outer, outer_first, step, inner, inner_first, up) =
  let (n = len(outer), m = len(inner), cuts = [for (k = [0:step:n - 1]) k],
       near = [for (k = cuts) nearest(inner, outer[k])])
  [for (s = [0:len(cuts) - 1])
     let (end = s + 1 < len(cuts) ? cuts[s + 1] : n, to = near[(s + 1)%len(cuts)],
          count = (to - near[s] + m)%m)
     reversed(concat([for (j = [cuts[s]:end]) outer_first + j%n],
                     [for (j = [0:count]) inner_first + (to - j + m)%m]), up)];
// the same with a polygon for every `step` points of the inner loop
function annulus_by_inner(outer, outer_first, inner, inner_first, step, up) =
  let (n = len(outer), m = len(inner), cuts = [for (k = [0:step:m - 1]) k],
       near = [for (k = cuts) nearest(outer, inner[k])])
  [for (s = [0:len(cuts) - 1])
     let (end = s + 1 < len(cuts) ? cuts[s + 1] : m, to = near[(s + 1)%len(cuts)],
          count = (to - near[s] + n)%n)
     reversed(concat([for (j = [cuts[s]:end]) inner_first + j%m],
                     [for (j = [0:count]) outer_first + (to - j + n)%n]), !up)];

// rows of a slab: [share of the height, turn]. `rate`: degrees a millimetre, to the left up to the share
// `apex` of the height, back above it
function part_rows(height, start, rate, from, to, apex, radius, tolerance) =
  let (n = to <= from ? 0 :
         max(1, ceil(abs(rate)*height*(to - from)/(2*acos(max(0, 1 - tolerance/radius))))))
  [for (i = [0:1:n - 1]) let (u = from + (to - from)*(i + 1)/n)
     [u, start + rate*height*(u <= apex ? u : 2*apex - u)]];
function rows(height, start, rate, apex, radius, tolerance) =
  concat([[0, start]], part_rows(height, start, rate, 0, min(1, apex), apex, radius, tolerance),
         part_rows(height, start, rate, max(0, apex), 1, apex, radius, tolerance));
straight = [[0, 0], [1, 0]];
function rows_of(slab) = len(slab) > 3 ? slab[3] : straight;

// walls of slabs [height, outline, points a tooth, rows] and where their rows begin
function slab_loops(slabs) =
  [for (s = slabs) for (r = rows_of(s))
     len(r) > 2 ? r[2] : r[1] == 0 ? s[1] : [for (p = s[1]) turned(p, r[1])]];
function slab_heights(slabs) =
  [for (i = [0:len(slabs) - 1]) for (r = rows_of(slabs[i])) heights_before(slabs, i) + r[0]*slabs[i][0]];
function rows_before(slabs, i) = i == 0 ? 0 : rows_before(slabs, i - 1) + len(rows_of(slabs[i - 1]));
function slab_walls(slabs, first, inwards = false) =
  [for (i = [0:len(slabs) - 1])
     let (b = rows_before(slabs, i), r = rows_of(slabs[i]))
     for (k = [0:len(r) - 2])
       for (f = r[k][1] == r[k + 1][1] && len(r[k]) < 3
                ? wall(first[b + k], first[b + k + 1], len(slabs[i][1]), inwards)
                : turned_wall(slabs[i][1], first[b + k], first[b + k + 1], r[k + 1][1] - r[k][1], inwards)) f];

// slabs [height, outline, points a tooth, rows], bottom to top, each inside or around its neighbours; with
// a bore through all of them, or none ([])
module stack(slabs, bore = []) {
  n = len(slabs);
  through = len(bore) > 0;
  loops = concat(slab_loops(slabs), through ? [bore, bore] : []);
  z = concat(slab_heights(slabs), [0, heights_before(slabs, n)]);
  first = [for (i = [0:len(loops)]) lengths_before(loops, i)];
  walls = slab_walls(slabs, first);
  steps = n < 2 ? [] : [for (i = [0:n - 2])
    let (b = rows_before(slabs, i + 1), a = b - 1,
         up = largest_radius(loops[a]) > largest_radius(loops[b]),
         o = up ? a : b, q = up ? b : a)
    for (f = annulus(loops[o], first[o], slabs[up ? i : i + 1][2], loops[q], first[q], up)) f];
  t = rows_before(slabs, n) - 1;  // the uppermost outer loop; the bore's follow it
  ends = through
    ? concat(wall(first[t + 1], first[t + 2], len(bore), true),
             annulus(loops[0], first[0], slabs[0][2], bore, first[t + 1], false),
             annulus(loops[t], first[t], slabs[n - 1][2], bore, first[t + 2], true))
    : [[for (i = [0:len(loops[0]) - 1]) i],
       [for (i = [len(loops[t]) - 1:-1:0]) first[t] + i]];
  polyhedron([for (i = [0:len(loops) - 1]) for (p = loops[i]) [p[0], p[1], z[i]]],
             concat(walls, steps, ends), convexity = 10);
}

// a ring: slabs [height, hole, points a tooth, rows] within a rim
module stack_in_rim(rim, slabs) {
  n = len(slabs);
  loops = concat(slab_loops(slabs), [rim, rim]);
  z = concat(slab_heights(slabs), [0, heights_before(slabs, n)]);
  first = [for (i = [0:len(loops)]) lengths_before(loops, i)];
  t = rows_before(slabs, n) - 1;
  steps = n < 2 ? [] : [for (i = [0:n - 2])
    let (b = rows_before(slabs, i + 1), a = b - 1,
         up = largest_radius(loops[a]) < largest_radius(loops[b]),
         q = up ? a : b, o = up ? b : a)
    for (f = annulus_by_inner(loops[o], first[o], loops[q], first[q], slabs[up ? i : i + 1][2], up)) f];
  polyhedron([for (i = [0:len(loops) - 1]) for (p = loops[i]) [p[0], p[1], z[i]]],
             concat(slab_walls(slabs, first, true), wall(first[t + 1], first[t + 2], len(rim)), steps,
                    annulus_by_inner(rim, first[t + 1], loops[0], first[0], slabs[0][2], false),
                    annulus_by_inner(rim, first[t + 2], loops[t], first[t], slabs[n - 1][2], true)),
             convexity = 10);
}
