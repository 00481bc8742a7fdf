# SPDX-License-Identifier: GPL-3.0-or-later
"""Gear, Rack and GearPair: values of handbooks, and those of the same gear from a design file."""
import math
import unittest

import numpy as np
import trueflank
from trueflank import Gear, GearPair, Rack


def design_of(gear, more=""):
    return trueflank.read_text(f"""format = 1
name = "g"
[gearbox]
kind = "gear"
module_mm = {gear.module_mm}
helix_angle_deg = {gear.helix_angle_deg}
[gear]
teeth = {gear.teeth}
shift = {gear.shift}
face_width_mm = {gear.face_width_mm}
{more}""")


class OneGear(unittest.TestCase):
    def test_handbook_values(self):
        # span of 24 teeth over 3: the tables' 7.7165 modules; diameters z m, (z + 2) m, (z - 2.5) m
        gear = Gear(24, module_mm=1)
        self.assertAlmostEqual(gear.span_mm(3), 7.7165, places=4)
        self.assertEqual((gear.reference_diameter_mm, gear.tip_diameter_mm, gear.root_diameter_mm), (24, 26, 21.5))
        self.assertAlmostEqual(gear.base_diameter_mm, 24 * math.cos(math.radians(20)), places=12)
        self.assertAlmostEqual(gear.tooth_thickness_mm(), math.pi / 2, places=12)

    def test_it_is_the_gear_of_a_design_file(self):
        for gear, more in [(Gear(17, module_mm=2, shift=0.2, face_width_mm=8, bore_mm=5), "bore_mm = 5"),
                           (Gear(9, shift=-0.1), ""),
                           (Gear(23, module_mm=1.5, helix_angle_deg=20), ""),
                           (Gear(60, internal=True, shift=0.3), "internal = true")]:
            gearbox = design_of(gear, more)
            expected = gearbox.report()["gears"]["gear"]
            for key in ("reference_diameter_mm", "base_diameter_mm", "tip_diameter_mm", "root_diameter_mm",
                        "root_form_diameter_mm", "tip_thickness_mm", "undercut", "pin_diameter_mm", "span_mm",
                        "over_pins_mm"):
                value = getattr(gear, key)
                value = value() if callable(value) else value
                if isinstance(expected[key], float):
                    self.assertAlmostEqual(value, expected[key], places=6, msg=key)
                else:
                    self.assertEqual(value, expected[key], key)
            np.testing.assert_array_equal(gear.profile(1), gearbox.profile(tolerance_um=1))
            mine, theirs = gear.mesh(5), gearbox.mesh("gear", 5)
            self.assertTrue(mine.is_valid)
            if not gear.internal:  # the design's ring has a rim of its own
                np.testing.assert_array_equal(mine.vertices, theirs.vertices)

    def test_a_tooth_is_a_turned_copy_of_the_first(self):
        gear = Gear(17)
        turn = 2 * math.pi / 17
        c, s = math.cos(turn), math.sin(turn)
        np.testing.assert_allclose(gear.tooth(2), gear.tooth(1) @ np.array([[c, s], [-s, c]]), atol=1e-12)
        np.testing.assert_array_equal(np.vstack([gear.tooth(k) for k in range(1, 18)]), gear.profile())

    def test_rack_and_tip_are_taken(self):
        gear = Gear(20, rack=Rack(pressure_angle_deg=25, dedendum=1.4, root_radius=0.2), tip_diameter_mm=21.5)
        self.assertEqual(gear.tip_diameter_mm, 21.5)
        self.assertAlmostEqual(gear.root_diameter_mm, 17.2, places=12)
        self.assertAlmostEqual(gear.rack.pressure_angle_deg, 25)
        self.assertEqual(gear.rack, Rack(25, 1, 1.4, 0.2))
        self.assertNotEqual(gear.rack, Rack())

    def test_rings_have_no_span_but_pins(self):
        ring = Gear(60, internal=True)
        self.assertIsNone(ring.span_mm())
        self.assertIsNone(ring.span_teeth)
        self.assertLess(ring.over_pins_mm(), ring.root_diameter_mm)
        self.assertGreater(ring.mesh(20).volume_mm3, 0)

    def test_what_cannot_be_is_refused_with_its_name(self):
        for call, key in [(lambda: Gear(2), "teeth"), (lambda: Gear(17, module_mm=float("nan")), "module_mm"),
                          (lambda: Gear(17, helix_angle_deg=80), "helix_angle_deg"),
                          (lambda: Gear(17, bore_mm=14.5), "bore_mm"),
                          (lambda: Gear(60, internal=True, outer_diameter_mm=60), "outer_diameter_mm"),
                          (lambda: Gear(17).span_mm(0), "teeth"), (lambda: Gear(17).tooth(18), "tooth"),
                          (lambda: Gear(17).over_pins_mm(0), "pin_diameter_mm"),
                          (lambda: Gear(17).tooth_thickness_mm(1), "diameter_mm"),
                          (lambda: Gear(17).profile(0), "tolerance_um"),
                          (lambda: Rack(pressure_angle_deg=0), "pressure_angle_deg")]:
            with self.assertRaises(trueflank.InputError) as caught:
                call()
            self.assertEqual(caught.exception.key, key)
        with self.assertRaises(trueflank.InputError):
            Gear(17, shift=9)
        with self.assertRaises(TypeError):
            Gear("17")


class Pair(unittest.TestCase):
    def test_handbook_pair(self):
        # KHK, gear technical reference, table 4.3: m 3, 12 and 24 teeth, x 0.6 and 0.36
        pair = GearPair(Gear(12, 3, 0.6), Gear(24, 3, 0.36))
        self.assertAlmostEqual(pair.centre_distance_mm, 56.4999, places=4)
        self.assertAlmostEqual(pair.working_pressure_angle_deg, 26.0886, places=4)
        self.assertAlmostEqual(pair.pitch_diameters_mm[0], 37.667, places=3)
        self.assertAlmostEqual(pair.backlash_mm, 0, places=12)

    def test_it_is_the_pair_of_a_design_file(self):
        report = trueflank.read_text("""format = 1
name = "p"
[gearbox]
kind = "pair"
module_mm = 1.0
centre_distance_mm = 28.6
[pinion]
teeth = 17
shift = 0.1
tip_diameter_mm = 19.2
face_width_mm = 10.0
[wheel]
teeth = 40
shift = 0.0
tip_diameter_mm = 42.0
face_width_mm = 10.0
""").report()["meshes"]["pinion-wheel"]
        pair = GearPair(Gear(17, shift=0.1, tip_diameter_mm=19.2), Gear(40, tip_diameter_mm=42.0), 28.6)
        self.assertAlmostEqual(pair.contact_ratio, report["contact_ratio"], places=9)
        self.assertAlmostEqual(pair.effective_contact_ratio, report["effective_contact_ratio"], places=9)
        self.assertAlmostEqual(pair.backlash_mm, report["backlash_mm"], places=9)
        self.assertAlmostEqual(pair.working_pressure_angle_deg, report["working_pressure_angle_deg"], places=6)
        self.assertAlmostEqual(pair.clearance_um(), report["minimum_clearance_um"], places=3)

    def test_thinned_teeth_have_that_much_backlash(self):
        pair = GearPair(Gear(17), Gear(40, thinning_mm=0.05))
        self.assertAlmostEqual(pair.backlash_mm, 0.05, places=12)
        self.assertGreater(pair.clearance_um(), 0)

    def test_an_internal_pair(self):
        pair = GearPair(Gear(20), Gear(60, internal=True))
        self.assertAlmostEqual(pair.centre_distance_mm, 20, places=12)
        self.assertGreater(pair.contact_ratio, 1)
        self.assertEqual(pair.gear2.teeth, 60)

    def test_a_pair_keeps_its_gears(self):
        pair = GearPair(Gear(17), Gear(40))  # nobody else holds them
        self.assertAlmostEqual(pair.gear1.reference_diameter_mm, 17)
        self.assertGreater(pair.contact_ratio, 1.5)

    def test_gears_that_do_not_mesh_are_refused(self):
        for one, two in [(Gear(17), Gear(40, module_mm=2)), (Gear(17, helix_angle_deg=10), Gear(40, helix_angle_deg=10)),
                         (Gear(60, internal=True), Gear(17)), (Gear(17), Gear(40, rack=Rack(25)))]:
            with self.assertRaises(trueflank.InputError):
                GearPair(one, two)
        with self.assertRaises(trueflank.InputError):
            GearPair(Gear(17), Gear(40), 10.0)  # the base circles are farther apart than this


if __name__ == "__main__":
    unittest.main(verbosity=1)
