# SPDX-License-Identifier: Apache-2.0
"""SubdivideVolume on files that image libraries crash or hang on."""

import os
import struct
import unittest

from subdivide_volume_case import ProgramTest, noise
from subdivide_volume_files import write_meta


class Crashes(ProgramTest):
    def cut(self, name, part):
        os.truncate(self.path(name), int(os.path.getsize(self.path(name)) * part))

    def write_bmp(self, name, width, height):
        """A picture of 24 bits a pixel; its rows have whole words."""
        pixels = bytes(noise(3 * width * height, 0, 256))
        header = struct.pack("<2sIHHI", b"BM", 54 + len(pixels), 0, 0, 54)
        header += struct.pack("<IiiHHIIiiII", 40, width, height, 1, 24, 0, len(pixels), 2835, 2835, 0, 0)
        with open(self.path(name), "wb") as file:
            file.write(header + pixels)

    def test_truncated_pictures(self):
        write_meta(self.path("flat.mha"), [200, 150], "B", noise(30000, 0, 256))
        for ending in ("png", "jpg", "bmp", "tif"):
            if ending == "bmp":
                self.write_bmp("cut.bmp", 200, 150)
            else:
                self.subdivide("flat.mha", f"cut.{ending}")
            self.cut(f"cut.{ending}", 1 / 3)
            with self.subTest(ending=ending):
                self.assert_fails(self.run_program(self.path(f"cut.{ending}"), self.path("out.mha")), 1, f"cut.{ending}")

    def test_a_vector_nifti_in_pieces(self):
        header = bytearray(352)
        struct.pack_into("<i", header, 0, 348)
        struct.pack_into("<8h", header, 40, 5, 8, 7, 6, 1, 3, 1, 1)
        struct.pack_into("<3h", header, 68, 1007, 4, 16)
        struct.pack_into("<8f", header, 76, *[1] * 8)
        struct.pack_into("<2f", header, 108, 352, 1)
        header[344:348] = b"n+1\0"
        with open(self.path("in.nii"), "wb") as file:
            file.write(header + struct.pack("<1008h", *noise(1008)))
        result = self.run_program(self.path("in.nii"), self.path("out.mha"), "--streams", 4)
        if result.returncode != 0:
            self.assert_fails(result, 1)
        self.assertEqual(os.path.exists(self.path("out.mha")), result.returncode == 0)
        self.assertFalse([name for name in os.listdir(self.folder) if "partial" in name])

    def test_a_named_pipe(self):
        os.mkfifo(self.path("pipe.mha"))
        self.assert_fails(self.run_program(self.path("pipe.mha"), self.path("out.mha")), 1, "pipe.mha", "pipe")


if __name__ == "__main__":
    unittest.main()
