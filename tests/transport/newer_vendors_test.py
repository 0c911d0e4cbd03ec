#!/usr/bin/env python3
"""Newer vendors than the distribution's, as far as that goes without them: their interface, declared in newer/, compiles
with our sources, and the build finds their packages or says why not. Usage: newer_vendors_test.py SOURCE_DIR GENERATED CXX CMAKE"""
import pathlib
import subprocess
import sys
import tempfile
import unittest

SOURCE, GENERATED, CXX, CMAKE = sys.argv[1:5]
NEWER = pathlib.Path(SOURCE) / "tests/transport/newer"

# the headers of Fast DDS 3 and Fast CDR 2 that there are, of those that we may ask for
HEADERS = {
    "fast_cdr_2.h": ["fastcdr/Cdr.h", "fastcdr/FastBuffer.h", "fastcdr/CdrEncoding.hpp", "fastcdr/exceptions/Exception.h",
                     "fastcdr/exceptions/BadParamException.h"],
    "fast_dds_3.h": ["fastdds/" + name + ".hpp" for name in (
        "LibrarySettings", "utils/md5", "utils/IPLocator", "rtps/attributes/ResourceManagement",
        "rtps/attributes/WriterAttributes", "rtps/transport/UDPv4TransportDescriptor", "dds/core/ReturnCode",
        "dds/core/Time_t", "dds/core/status/LivelinessChangedStatus", "dds/common/InstanceHandle", "dds/log/Log",
        "dds/domain/DomainParticipant", "dds/domain/DomainParticipantFactory", "dds/publisher/DataWriter",
        "dds/publisher/Publisher", "dds/publisher/qos/DataWriterQos", "dds/subscriber/DataReader",
        "dds/subscriber/DataReaderListener", "dds/subscriber/SampleInfo", "dds/subscriber/Subscriber",
        "dds/subscriber/qos/DataReaderQos", "dds/topic/Topic", "dds/topic/TopicDataType", "dds/topic/TypeSupport")],
}


def write(path, text):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")


class Scratch(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)


class FastDds3Test(Scratch):
    def test_each_source_of_ours_compiles_against_its_interface(self):
        for declared, names in HEADERS.items():
            for name in names:
                write(self.folder / name, f'#include "{NEWER / declared}"\n')
        sources = sorted(pathlib.Path(SOURCE).glob("transport/fast/*.cpp"))
        self.assertGreater(len(sources), 4)
        write(self.folder / "all.cpp", "".join(f'#include "{source}"\n' for source in sources))
        read = self.folder / "read.d"
        done = subprocess.run(
            [CXX, "-std=c++20", "-fsyntax-only", "-Wall", "-Wextra", "-Werror", "-I", self.folder, "-I", SOURCE, "-I",
             GENERATED, "-MD", "-MF", read, self.folder / "all.cpp"], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        # an older version's header, if one is installed, would hide that there is none any more
        foreign = [path for path in read.read_text(encoding="utf-8").split()
                   if any(part in path for part in ("/fastdds/", "/fastrtps/", "/fastcdr/")) and str(self.folder) not in path]
        self.assertEqual(foreign, [])


class PackagesTest(Scratch):
    def package(self, name, version, config=""):
        folder = self.folder / "prefix/lib/cmake" / name
        write(folder / f"{name}Config.cmake", config)
        major = version.split(".")[0]  # as both vendors' own check has it
        write(folder / f"{name}ConfigVersion.cmake", f"""set(PACKAGE_VERSION {version})
if(NOT PACKAGE_FIND_VERSION OR PACKAGE_FIND_VERSION_MAJOR EQUAL {major})
  set(PACKAGE_VERSION_COMPATIBLE TRUE)
endif()
""")

    def configure(self):
        """What `cmake` says where only the packages of this test are, and whether it went well."""
        write(self.folder / "CMakeLists.txt", f"""cmake_minimum_required(VERSION 3.25)
project(Found NONE)
include("{SOURCE}/cmake/OmentumDds.cmake")
get_target_property(libraries omentum_fast_dds INTERFACE_LINK_LIBRARIES)
message(STATUS "links ${{libraries}}")
""")
        done = subprocess.run(
            [CMAKE, "-G", "Unix Makefiles", "-DCMAKE_MAKE_PROGRAM=true", "-S", self.folder, "-B", self.folder / "build", f"-DCMAKE_PREFIX_PATH={self.folder / 'prefix'}",
             "-DCMAKE_FIND_USE_CMAKE_SYSTEM_PATH=OFF", "-DCMAKE_FIND_USE_SYSTEM_ENVIRONMENT_PATH=OFF",
             "-DCMAKE_FIND_USE_CMAKE_ENVIRONMENT_PATH=OFF"], capture_output=True, text=True, check=False)
        return done.returncode == 0, " ".join((done.stdout + done.stderr).split())

    def test_the_newest_of_both_are_found_although_their_check_takes_one_major_version_only(self):
        self.package("fastcdr", "2.3.0")
        self.package("fastdds", "3.6.2")
        self.package("CycloneDDS", "11.0.1")
        good, said = self.configure()
        self.assertTrue(good, said)
        for words in ("Fast DDS 3.6.2", "Cyclone DDS 11.0.1", "links fastdds;fastcdr"):
            self.assertIn(words, said)

    def test_before_3_fast_dds_had_another_name(self):
        self.package("fastcdr", "2.2.0")
        self.package("fastrtps", "2.14.4")
        self.package("CycloneDDS", "0.10.5")
        good, said = self.configure()
        self.assertTrue(good, said)
        for words in ("Fast DDS 2.14.4", "Cyclone DDS 0.10.5", "links fastrtps;fastcdr"):
            self.assertIn(words, said)

    def test_what_was_not_thought_of_is_named(self):
        self.package("fastcdr", "1.0.20")
        self.package("fastrtps", "2.8.0")
        self.package("CycloneDDS", "12.0.0")
        good, said = self.configure()
        self.assertFalse(good)
        self.assertIn("Fast DDS 2.8.0 was found; Omentum is written for 2.9 and later, below 4", said)
        self.package("fastrtps", "2.9.1")
        good, said = self.configure()
        self.assertFalse(good)
        self.assertIn("Cyclone DDS 12.0.0 was found; Omentum is written for 0.10 and later, below 12", said)

    def test_what_is_missing_is_named(self):
        self.package("fastcdr", "1.0.26")
        good, said = self.configure()
        self.assertFalse(good)
        self.assertIn("libfastrtps-dev", said)
        self.package("fastrtps", "2.9.1")
        good, said = self.configure()
        self.assertFalse(good)
        self.assertIn("cyclonedds-dev", said)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
