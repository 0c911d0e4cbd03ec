#!/usr/bin/env python3
"""Which rows network_bench measures, and what it makes of the programs' reports and of the pings beside them."""
import contextlib
import io
import pathlib
import sys
import unittest
from unittest import mock

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(REPOSITORY / "benchmarks"))
import network_bench  # noqa: E402 (a program, no installed package)


class Rows(unittest.TestCase):
    def test_all_are_measured_unless_some_are_named(self):
        rows = network_bench.chosen_rows([])
        self.assertEqual(len(rows), len(set(rows)))
        self.assertEqual(len(rows), 5 * 3 * 2)
        self.assertEqual(rows[0], "loopback/fast/plain")

    def test_a_word_or_a_pattern_names_those_that_have_it_in_the_order_of_the_table(self):
        self.assertEqual(network_bench.chosen_rows(["hosts/cyclone/secured"]), ["hosts/cyclone/secured"])
        self.assertEqual(len(network_bench.chosen_rows(["mixed"])), 5 * 2)
        self.assertEqual(network_bench.chosen_rows(["lossy?/fast/plain", "loopback/*/secured"]),
                         ["loopback/fast/secured", "loopback/cyclone/secured", "loopback/mixed/secured", "lossy1/fast/plain",
                          "lossy5/fast/plain"])

    def test_what_names_no_row_is_refused_by_its_name(self):
        with self.assertRaisesRegex(ValueError, "--rows: found 'fats'"):
            network_bench.chosen_rows(["loopback", "fats"])

    def test_without_namespaces_the_rows_of_one_machine_are_measured_and_why_is_said(self):
        said = io.StringIO()
        with mock.patch.object(network_bench, "without_network", return_value="namespaces need root"), \
                mock.patch.object(network_bench, "measure", return_value=([], True)) as measure, \
                mock.patch.object(sys, "argv", ["network_bench", "--rows", "fast"]), contextlib.redirect_stdout(said):
            self.assertEqual(network_bench.main(), 0)
        self.assertEqual(measure.call_args.args[0], ["loopback/fast/plain", "loopback/fast/secured"])
        self.assertIn("rows of several machines are left out: namespaces need root", said.getvalue())
        self.assertIn("2 rows, about 1 minutes", said.getvalue())


def times(p50, p99, p999, count):
    return {"p50": p50, "p99": p99, "p999": p999, "max": p999, "count": count}


class Figures(unittest.TestCase):
    ROW = "lossy1/mixed/secured"

    def setUp(self):
        self.reports = {
            "virtual_device": {"unanswered": 400, "link": {"tool_to_force_us": times(200.0, 900.0, 4000.0, 19600),
                                                           "tool_to_organ_us": times(5000.0, 30000.0, 40000.0, 150),
                                                           "tool_to_picture_us": times(0.0, 0.0, 0.0, 0)}},
            "render_node": {"organ_states": {"whole": 540, "incomplete": 60, "missing": 6}}}
        self.pinged = {name: {"sent": 1000, "lost": lost, "round_trip_us": times(50.0, 90.0, 100.0, 1000 - lost)}
                       for name, lost in (("force", 0), ("organ", 20), ("picture", 30))}

    def found(self):
        return {one["name"].removeprefix(f"network/{self.ROW}/"): one
                for one in network_bench.figures(self.ROW, self.reports, self.pinged)}

    def test_latencies_are_ratios_to_the_pings_of_the_same_way_and_share(self):
        self.assertEqual(self.found()["force/p999"],
                         {"name": f"network/{self.ROW}/force/p999", "value": 4000.0, "unit": "us", "reference": 100.0, "ratio": 40.0})
        self.assertEqual(self.found()["organ/p99"]["ratio"], 30000 / 90)

    def test_a_percentile_of_fewer_samples_than_it_cuts_off_is_not_told(self):
        self.assertIn("organ/p99", self.found())
        self.assertNotIn("organ/p999", self.found())
        self.reports["virtual_device"]["link"]["tool_to_organ_us"]["count"] = 1000
        self.assertIn("organ/p999", self.found())
        self.assertFalse([name for name in self.found() if name.startswith("picture/")], "none came")

    def test_losses_are_shares_of_what_was_sent_beside_the_share_of_pings(self):
        found = self.found()
        self.assertAlmostEqual(found["poses_unanswered"]["value"], 400 / 20000)
        self.assertNotIn("ratio", found["poses_unanswered"], "no ping was lost there")
        self.assertAlmostEqual(found["states_incomplete"]["value"], 60 / 600)
        self.assertAlmostEqual(found["states_missing"]["value"], 6 / 606)
        self.assertAlmostEqual(found["states_missing"]["reference"], 0.03)

    def test_a_row_of_the_table_has_a_cell_for_each_head_and_reads_as_it_says(self):
        cells = network_bench.cells(self.ROW, network_bench.figures(self.ROW, self.reports, self.pinged))
        self.assertEqual(len(cells), len(network_bench.HEAD))
        self.assertEqual(cells, ["three machines, 1 ms, 1 % lost", "mixed", "secured", "0.0500, 0.0900, 0.100",
                                 "0.200, 0.900, 4.00 (4.0, 10, 40)",
                                 "5.00, 30.0 (100, 333)", "none came", "2.0 % (0.0 %)", "10.0 %, 1.0 % (3.0 %)"])

    def test_numbers_are_short_at_any_size(self):
        self.assertEqual([network_bench.short(one) for one in (0, 0.0456, 0.9, 7.251, 36.66, 1234.5)],
                         ["0", "0.0456", "0.900", "7.25", "36.7", "1234"])


if __name__ == "__main__":
    unittest.main(verbosity=2)
