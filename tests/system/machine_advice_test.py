#!/usr/bin/env python3
"""What the launcher says should be changed on a machine, and whether datagrams pass."""
import pathlib
import sys
import unittest

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(REPOSITORY / "launch_scripts"))
from launcher import domain, machine_advice, reach  # noqa: E402 (the launcher is no installed package)


class Advice(unittest.TestCase):
    def facts(self, **other):
        network = {"lan0": {"address": "10.0.0.1", "up": True, "loopback": False, "multicast": True}}
        return {"rmem_max": 4 << 20, "may_be_realtime": True, "governors": ["performance"], "interfaces": network, "interface": None, **other}

    def of(self, facts, address="10.0.0.1"):
        return [*machine_advice.of_interface(facts, address), *machine_advice.of_realtime(facts),
                *machine_advice.of_buffers(facts), *machine_advice.of_processors(facts)]

    def test_a_machine_as_it_should_be_hears_nothing_and_each_fault_is_one_line(self):
        self.assertEqual(self.of(self.facts()), [])
        bare = {"lan0": {"address": "10.0.0.1", "up": True, "loopback": False, "multicast": False}}
        for other, about in (({"rmem_max": 212992}, "sysctl -w net.core.rmem_max=4194304"), ({"may_be_realtime": False}, "rtprio"),
                             ({"governors": ["powersave"]}, "cpupower"), ({"interfaces": bare}, "multicast on"),
                             ({"interface": "wlan0"}, "no interface is called or has wlan0; there are: lan0 10.0.0.1")):
            line, = self.of(self.facts(**other))
            self.assertIn(about, line)
        self.assertIn("the others are told 10.0.0.9", self.of(self.facts(interface="lan0"), address="10.0.0.9")[0])

    def test_a_network_without_a_table_needs_one_interface_with_multicast(self):
        lo = {"lo": {"address": "127.0.0.1", "up": True, "loopback": True, "multicast": False}}
        plain = {**lo, "eth0": {"address": "10.0.0.1", "up": True, "loopback": False, "multicast": False}}
        self.assertEqual(machine_advice.of_network(self.facts()), [])
        self.assertIn("no interface but the loopback", machine_advice.of_network(self.facts(interfaces=lo))[0])
        self.assertIn("OMENTUM_DDS_PEERS", machine_advice.of_network(self.facts(interfaces=plain))[0])

    def test_the_buffers_are_those_that_the_nodes_ask_for(self):
        self.assertIn("kSocketBufferBytes = 4 * 1024 * 1024;", (REPOSITORY / "transport" / "settings.h").read_text())
        self.assertEqual(machine_advice.SOCKET_BUFFER_BYTES, 4 * 1024 * 1024)

    def test_clocks_count_as_apart_beyond_what_the_measurement_leaves_open(self):
        self.assertEqual(machine_advice.of_clock(apart_s=0.4, uncertain_s=0.0), [])
        self.assertEqual(machine_advice.of_clock(apart_s=1.4, uncertain_s=0.5), [])
        self.assertIn("2.0 s behind", machine_advice.of_clock(apart_s=-2.0, uncertain_s=0.5)[0])

    def test_ports_that_answer_are_open_and_others_are_named(self):
        number = next(n for n in range(60, 100) if not domain.has_participant(n))
        echo = reach.Echo("other", number, "127.0.0.1")
        try:
            heard = reach.probe(number, "127.0.0.1", {"other": ["127.0.0.1", echo.ports], "absent": ["127.0.0.2", echo.ports[:2]]})
        finally:
            echo.close()
        self.assertEqual(heard["absent"], [])
        self.assertLessEqual(set(reach.participant_ports(number)), set(echo.ports))
        self.assertLessEqual(set(map(str, echo.ports)), set(heard["other"]))
        ports = {"other": echo.ports, "absent": echo.ports[:2]}
        line, = machine_advice.of_reach({"theatre": heard}, ports, number, needs_multicast=False)
        self.assertIn("theatre does not reach absent by UDP at any port", line)
        half, unheard = [str(echo.ports[0])], list(map(str, echo.ports))
        self.assertIn(f"at {echo.ports[1]}, ", machine_advice.of_reach({"theatre": {"other": half}}, ports, number)[0])
        self.assertIn("does not hear theatre's multicast", machine_advice.of_reach({"theatre": {"other": unheard}}, ports, number)[0])

    def test_a_domain_in_which_anybody_is_here_is_not_free(self):
        number = next(n for n in range(60, 100) if not domain.has_participant(n))
        with reach.multicast_socket(number, "127.0.0.1"):  # as each program of the domain has it, launched or not
            self.assertTrue(domain.has_participant(number))
            self.assertIsNone(domain.claim_here(number))
            domain.claim_here(number, may_join=True).close()
        self.assertFalse(domain.has_participant(number))


if __name__ == "__main__":
    unittest.main()
