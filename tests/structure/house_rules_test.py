#!/usr/bin/env python3
"""The guard is awake: every kind of breach, planted in a small tree of its own, is caught at its line."""
import pathlib
import tempfile
import unittest

import house_rules

ALLOWED = {
    "geometry/surface.cpp": '#include "geometry/surface.h"\n#include <Eigen/Core>\n',
    "physics/law.cpp": '#include "geometry/types.h"\n',
    "organ/organ.cpp": '#include "physics/material.h"\n#include "geometry/types.h"\n',
    "transport/fast/bus.cpp": '#include <fastdds/dds/domain/DomainParticipant.hpp>\n#include "messages/all.h"\n',
    "transport/cyclone/bus.cpp": '#include "dds/dds.h"\n',
    "render_node/gl/window.cpp": '#include <GLFW/glfw3.h>\n#include <backends/imgui_impl_opengl3.h>\n'
    '#include "render_node/panel.h"\n',
    "device_bridge/mouse.cpp": "#include <linux/input.h>\n",
    "haptic_node/loop.cpp": '#include "runtime/clock.h"\n#include "transport/bus.h"\n#include "tests"\n',
    "tests/nodes/loop_test.cpp": '#include "haptic_node/loop.h"\n#include "deform_node/loop.h"\n',
    "organ_tools/phantom/mesher.cpp": "#include <CGAL/Mesh_3.h>\n",
    "build/release/consumer/main.cpp": '#include "anything/at/all.h"\n',
}
PLANTED = {
    "geometry/upward.cpp": '#include "physics/material.h"',
    "physics/upward.cpp": '#include "organ/organ.h"',
    "runtime/not_alone.cpp": '#include "geometry/types.h"',
    "idl/not_alone.h": '#include "transport/bus.h"',
    "transport/runtime_user.cpp": '#include "runtime/clock.h"',
    "haptic_node/neighbour.cpp": '#include "deform_node/organ_models.h"',
    "organ_tools/node_user.cpp": '#include "haptic_node/haptic_step.h"',
    "organ/tests_user.cpp": '#include "tests/support/bar.h"',
    "haptic_node/dds_user.cpp": "#include <fastdds/dds/topic/Topic.hpp>",
    "deform_node/dds_user.cpp": '#include "dds/dds.h"',
    "tests/nodes/dds_user.cpp": "  #  include <fastcdr/Cdr.h>",
    "render_node/gl_user.cpp": "#include <epoxy/gl.h>",
    "render_node/backend_user.cpp": "#include <backends/imgui_impl_opengl3.h>",
    "runtime/transport_user.cpp": '#include "transport/bus.h"',
    "organ/messages_user.cpp": '#include "messages/all.h"',
    "render_node/unknown_room.cpp": '#include "helpers/strings.h"',
    "physics/sideways.cpp": '#include "../haptic_node/haptic_step.h"',
    "haptic_node/device_user.cpp": "#include <linux/input.h>",
    "organ_tools/organ_build/cgal_user.cpp": "#include <CGAL/Mesh_3.h>",
}


class HouseRules(unittest.TestCase):
    def tree(self, files):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        for path, text in files.items():
            file = pathlib.Path(folder.name, path)
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(text)
        return pathlib.Path(folder.name)

    def test_what_points_down_passes(self):
        self.assertEqual(house_rules.breaches(self.tree(ALLOWED)), [])

    def test_every_planted_breach_is_caught_at_its_line(self):
        for path, include in PLANTED.items():
            with self.subTest(path=path):
                found = house_rules.breaches(self.tree({**ALLOWED, path: f"// why\n{include}\n"}))
                self.assertEqual(len(found), 1)
                self.assertTrue(found[0].startswith(f"{path}:2: "), found[0])

    def test_sources_outside_every_room_are_caught(self):
        for path in ("helpers/strings.cpp", "scratch.cpp"):
            with self.subTest(path=path):
                found = house_rules.breaches(self.tree({**ALLOWED, path: "int x;\n"}))
                self.assertEqual(len(found), 1)
                self.assertTrue(found[0].startswith(f"{path}:1: "), found[0])

    def test_documents_and_sections_that_are_not_there_are_caught(self):
        there, absent = "docs/there" + ".md", "docs/absent" + ".md"
        for cited, right in ((there, True), (f'{there}, "Contact"', True), (f'{there}, "Cont"', False), (absent, False),
                             ("ABSENT" + ".md", False)):
            with self.subTest(cited=cited):
                found = house_rules.wrong_citations(self.tree({there: "# There\n\n## Contact\n",
                                                               "physics/law.cpp": f"int x;\n// see {cited}.\n"}))
                self.assertEqual([line.split(" ")[0] for line in found], [] if right else ["physics/law.cpp:2:"])

    def test_rooms_that_clang_tidy_passes_over_are_caught(self):
        rooms = {"files/a.cpp": "", "scene/b.cpp": "", "scene/c.h": "", "tests/d.cpp": "", "idl/e.py": ""}
        lint, header_filter = "rooms='files|{}'\n", "Checks: >\nHeaderFilterRegex: '^.*/(files|{})/[^/]+\\.h$'\n"
        for lint_names, tidy_names, expected in (
                ("scene", "scene", []),
                ("organ", "scene", ["launch_scripts/lint:1: leaves out scene, which has .cpp files"]),
                ("scene", "organ", [".clang-tidy:2: leaves out scene, which has .h files"]),
                ("scene|node", "scene", ["launch_scripts/lint:1: names node, which is no room"])):
            with self.subTest(lint=lint_names, tidy=tidy_names):
                self.assertEqual(house_rules.unlinted_rooms(self.tree({
                    **rooms, "launch_scripts/lint": lint.format(lint_names),
                    ".clang-tidy": header_filter.format(tidy_names)})), expected)

    def test_without_its_lists_clang_tidy_looks_at_no_room(self):
        self.assertEqual(len(house_rules.unlinted_rooms(self.tree({"files/a.cpp": "", "files/a.h": ""}))), 2)

    def test_what_somebody_downloaded_is_caught(self):
        found = house_rules.left_about(self.tree({"server_1%3a9.2_amd64.deb": "", "tests/a.tar.gz": "", "docs/a.jpg": "", "build/a.deb": ""}))
        self.assertEqual(found, ["server_1%3a9.2_amd64.deb:1: is nobody's source", "tests/a.tar.gz:1: is nobody's source"])

    def test_a_long_main_of_a_node_is_caught(self):
        found = house_rules.breaches(self.tree({"deform_node/main.cpp": "int x;\n" * 61}))
        self.assertEqual(len(found), 1)


if __name__ == "__main__":
    unittest.main()
