#!/usr/bin/env python3
"""What session_bench makes of a session's report and of cyclictest's result."""
import pathlib
import sys
import unittest

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(REPOSITORY / "benchmarks"))
import session_bench  # noqa: E402 (a program, no installed package)


def floor(histogram, longest, overflows=0):
    return session_bench.floor_of({"thread": {"0": {
        "histogram": {str(us): count for us, count in histogram.items()}, "max": longest,
        "cycles": sum(histogram.values()) + overflows}}})


class Floor(unittest.TestCase):
    def test_quantiles_are_those_of_all_wake_ups_in_whatever_order_they_are_listed(self):
        found = floor({900: 5, 20: 600, 30: 395}, 900)
        self.assertEqual((found["p50"], found["p99"], found["p999"]), (20, 30, 900))

    def test_what_the_histogram_leaves_out_is_as_late_as_the_latest(self):
        found = floor({20: 980}, 250_000, overflows=20)
        self.assertEqual((found["p50"], found["p99"]), (20, 250_000))
        self.assertAlmostEqual(found["missed"], 0.02)

    def test_a_wake_up_a_period_late_is_a_missed_one(self):
        self.assertAlmostEqual(floor({20: 990, 999: 5, 1000: 3, 4000: 2}, 4000)["missed"], 0.005)


class Figures(unittest.TestCase):
    TIMES = {"p50": 1000.0, "p99": 1100.0, "p999": 1500.0}

    def figures(self, measured, device=True):
        nodes = {"haptic_node": {"loop": {"ticks": 2000, "missed": 4, "period_us": self.TIMES}}}
        if device:
            nodes["virtual_device"] = {"round_trip_us": {"p50": 180.0, "p99": 400.0, "p999": 900.0}}
        report = {"machine": {"steal_share": 0.01}, "nodes": nodes}
        return {each["name"]: each for each in session_bench.figures("busy", report, measured)}

    def test_are_ratios_to_what_cyclictest_met(self):
        found = self.figures({"p50": 20.0, "p99": 50.0, "p999": 400.0, "missed": 0.001})
        self.assertEqual(found["session/busy/period_jitter/p99"],
                         {"name": "session/busy/period_jitter/p99", "value": 100.0, "unit": "us", "reference": 50.0, "ratio": 2.0})
        self.assertEqual(found["session/busy/hand_to_force/p50"]["ratio"], 9.0)
        self.assertEqual(found["session/busy/missed"]["ratio"], 2.0)
        self.assertEqual(found["session/busy/steal_share"]["value"], 0.01)

    def test_a_floor_of_nothing_gives_no_ratio(self):
        self.assertNotIn("ratio", self.figures({"p50": 20.0, "p99": 50.0, "p999": 60.0, "missed": 0.0})["session/busy/missed"])

    def test_without_cyclictest_and_without_a_hand_the_rest_is_told(self):
        found = self.figures({}, device=False)
        self.assertNotIn("reference", found["session/busy/period_jitter/p99"])
        self.assertFalse([name for name in found if "hand_to_force" in name])


if __name__ == "__main__":
    unittest.main(verbosity=2)
