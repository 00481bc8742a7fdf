# SPDX-License-Identifier: GPL-3.0-or-later
"""The blind trial with fixed limits: false alarms, effects with a name, forms without one. The seed may be changed
(TRUEFLANK_BLIND_SEED); the limits hold for any."""
import os
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent / "blind"))
import blind  # noqa: E402
import nothing  # noqa: E402
import shop_floor  # noqa: E402
import trial  # noqa: E402

SEED = int(os.environ.get("TRUEFLANK_BLIND_SEED", "1"))
CAMPAIGN = "TRUEFLANK_CAMPAIGN" in os.environ  # the gate tries half of the effects and forms


class BlindTrial(unittest.TestCase):
    def run_cases(self, kind, count):
        return self.wrong_of(kind, [blind.Case(kind, i, SEED, "") for i in range(count)])

    def wrong_of(self, kind, cases):
        folder, count = pathlib.Path(os.environ["TRUEFLANK_TEST_OUTPUT"]) / "blind", len(cases)
        trial.run_all(cases, os.environ["TRUEFLANK_PROGRAM"], folder)
        wrong = [case.line() for case in cases if not case.right]
        print(f"seed {SEED}: {kind}: {count - len(wrong)} of {count} right")
        print("\n".join(wrong))
        for case in cases:
            self.assertIsNotNone(case.answer, case.line())
            held = [case.answer[k]["held_out_rms_um"] for k in ("before", "after")]
            if None not in held:
                self.assertLessEqual(held[1], held[0] * 1.000001, "an answer made the held-out error larger: " + case.line())
        return len(wrong)

    def test_nothing_hidden_seldom_alarms(self):
        # At 3 % six or more of 60 come once or twice in a hundred such tests; the few of the gate are quiet.
        self.assertLessEqual(*((self.run_cases("null", 60), 5) if CAMPAIGN else (self.run_cases("null", 7), 0)))

    def test_what_has_a_name_is_named(self):
        self.assertLessEqual(*((self.run_cases("named", 33), 4) if CAMPAIGN else (self.run_cases("named", 6), 0)))

    def test_orders_that_chance_made_of_four_fifths_of_the_data_are_not_told(self):
        # Beside a lobing and beside a taper: these were told with ghost orders.
        self.assertEqual(self.wrong_of("named", [blind.Case("named", i, 77011, "") for i in (2, 30)]), 0)

    def test_orders_of_either_flank_that_look_like_others_on_eleven_teeth_are_told(self):
        self.assertEqual(self.wrong_of("shop", [shop_floor.Case(22, 1, 180002)]), 0)

    def test_coarse_readings_are_no_more_than_their_noise(self):
        # Four of 60 that were: the noise is known badly beside steps of 2.5 times its size.
        cases = [nothing.Case(i, 4008, "all teeth coarse", nothing.kinds()["all teeth coarse"]) for i in ((30, 32, 34, 38) if CAMPAIGN else (30, 38))]
        self.assertEqual(self.wrong_of("nothing", cases), 0)

    def test_what_has_no_name_is_seen_and_not_misnamed(self):
        self.assertLessEqual(*((self.run_cases("unnamed", 39), 7) if CAMPAIGN else (self.run_cases("unnamed", 7), 1)))


if __name__ == "__main__":
    unittest.main()
