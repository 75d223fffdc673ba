"""The readers and writers behind scripts/fetch_data.py, against files built here by hand."""

import array
import io
import math
import pathlib
import struct
import sys
import unittest
import zipfile
import zlib

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "scripts"))
import image_files  # noqa: E402


def png(width, height, depth, colour, lines, palette=None, interlaced=0):
    """`lines`: one (filter, bytes) a scan line, already filtered."""

    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))

    raw = b"".join(bytes([kind]) + line for kind, line in lines)
    # The data is split over two chunks, as real encoders do.
    packed = zlib.compress(raw)
    return (
        b"\x89PNG\r\n\x1a\n"
        + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, depth, colour, 0, 0, interlaced))
        + (chunk(b"PLTE", palette) if palette else b"")
        + chunk(b"IDAT", packed[:5])
        + chunk(b"IDAT", packed[5:])
        + chunk(b"IEND", b"")
    )


class png_reader(unittest.TestCase):
    def test_every_filter_is_undone(self):
        lines = [
            (0, bytes([10, 20, 30])),
            (1, bytes([5, 1, 255])),  # 5, 6, 5
            (2, bytes([1, 1, 1])),  # 6, 7, 6
            (3, bytes([10, 10, 10])),  # 10 + 6/2 = 13, 10 + (13+7)/2 = 20, 10 + (20+6)/2 = 23
            (4, bytes([1, 2, 3])),  # Paeth of (0,13,0) = 13 -> 14; (14,20,13) = 20 -> 22; (22,23,20) = 23 -> 26
        ]
        self.assertEqual(
            image_files.read_image(png(3, 5, 8, 0, lines)),
            (3, 5, 1, bytes([10, 20, 30, 5, 6, 5, 6, 7, 6, 13, 20, 23, 14, 22, 26])),
        )

    def test_paeth_takes_the_corner_when_it_is_nearest(self):
        # left 10, up 30, corner 20: the estimate is 20, so the corner is nearest; and left wins a tie with up.
        image = image_files.read_image(png(2, 2, 8, 0, [(0, bytes([20, 30])), (4, bytes([246, 7]))]))
        self.assertEqual(image[3][2:], bytes([10, 27]))
        image = image_files.read_image(png(2, 2, 8, 0, [(0, bytes([5, 5])), (4, bytes([0, 1]))]))
        self.assertEqual(image[3][2:], bytes([5, 6]))

    def test_colour_filters_reach_three_bytes_back(self):
        image = image_files.read_image(png(2, 1, 8, 2, [(1, bytes([1, 2, 3, 10, 20, 30]))]))
        self.assertEqual(image, (2, 1, 3, bytes([1, 2, 3, 11, 22, 33])))

    def test_packed_bits_are_scaled_to_grey(self):
        image = image_files.read_image(png(10, 1, 1, 0, [(0, bytes([0b10110000, 0b01000000]))]))
        self.assertEqual(image[3], bytes(255 * bit for bit in (1, 0, 1, 1, 0, 0, 0, 0, 0, 1)))

    def test_palette_and_alpha(self):
        grey = image_files.read_image(png(4, 1, 2, 3, [(0, bytes([0b00011011]))], bytes([0] * 3 + [128] * 3 + [255] * 3 + [7] * 3)))
        self.assertEqual(grey, (4, 1, 1, bytes([0, 128, 255, 7])))
        colour = image_files.read_image(png(1, 1, 8, 6, [(0, bytes([1, 2, 3, 99]))]))
        self.assertEqual(colour, (1, 1, 3, bytes([1, 2, 3])))

    def test_broken_files_are_refused(self):
        good = png(3, 1, 8, 0, [(0, bytes(3))])
        damaged = bytearray(good)
        damaged[-20] ^= 1
        cases = {
            "truncated": good[:-15],
            "check sum": bytes(damaged),
            "interlaced": png(3, 1, 8, 0, [(0, bytes(3))], interlaced=1),
            "16 bits": png(1, 1, 16, 0, [(0, bytes(2))]),
            "too few lines": png(3, 2, 8, 0, [(0, bytes(3))]),
            "filter": png(3, 1, 8, 0, [(5, bytes(3))]),
            "short palette": png(1, 1, 8, 3, [(0, bytes([1]))], bytes(3)),
            "no palette": png(1, 1, 8, 3, [(0, bytes([1]))]),
            "another format": b"GIF89a",
        }
        for name, data in cases.items():
            with self.subTest(name), self.assertRaises(image_files.format_error):
                image_files.read_image(data)


class pnm(unittest.TestCase):
    def test_comments_and_spaces_do_not_change_what_is_written(self):
        pixels = bytes(range(12))
        image = image_files.read_image(b"P6\n# by hand\n2  2\n# again\n255\n" + pixels)
        self.assertEqual(image, (2, 2, 3, pixels))
        self.assertEqual(image_files.write_pnm(image), b"P6\n2 2\n255\n" + pixels)
        self.assertEqual(image_files.write_pnm((1, 1, 1, b"x")), b"P5\n1 1\n255\nx")

    def test_broken_files_are_refused(self):
        for data in (b"P5\n2 2\n65535\n" + bytes(8), b"P5\n2 2\n255\n" + bytes(3), b"P5\nx"):
            with self.subTest(data), self.assertRaises(image_files.format_error):
                image_files.read_image(data)


class float_maps(unittest.TestCase):
    rows = array.array("f", [1.5, 2.5, math.inf, 4.0, 5.0, 6.0])  # 3 wide, 2 high

    def test_pfm_is_bottom_up_and_either_endian(self):
        little = b"Pf\n3 2\n-0.0039\n" + struct.pack("<6f", *self.rows[3:], *self.rows[:3])
        big = b"Pf\n3 2\n1.0\n" + struct.pack(">6f", *self.rows[3:], *self.rows[:3])
        for data in (little, big):
            self.assertEqual(image_files.read_pfm(data), (3, 2, self.rows))
        self.assertEqual(image_files.write_pfm((3, 2, self.rows)), little.replace(b"-0.0039", b"-1.0"))

    def test_npz(self):
        self.assertEqual(image_files.read_npz(self.npz("<f4", "False", (2, 3))), (3, 2, self.rows))

    def npz(self, kind, fortran, shape, members=1):
        header = f"{{'descr': '{kind}', 'fortran_order': {fortran}, 'shape': {shape}, }}".ljust(117).encode() + b"\n"
        npy = b"\x93NUMPY\x01\x00" + struct.pack("<H", len(header)) + header + struct.pack("<6f", *self.rows)
        stream = io.BytesIO()
        with zipfile.ZipFile(stream, "w") as archive:
            for member in range(members):
                archive.writestr(f"arr_{member}.npy", npy)
        return stream.getvalue()

    def test_broken_maps_are_refused(self):
        cases = [
            (image_files.read_pfm, b"PF\n1 1\n-1\n" + bytes(12)),
            (image_files.read_pfm, b"Pf\n2 2\n-1\n" + bytes(12)),
            (image_files.read_npz, b"not a zip"),
            (image_files.read_npz, self.npz("<f8", "False", (2, 3))),
            (image_files.read_npz, self.npz("<f4", "True", (2, 3))),
            (image_files.read_npz, self.npz("<f4", "False", (6,))),
            (image_files.read_npz, self.npz("<f4", "False", (2, 4))),
            (image_files.read_npz, self.npz("<f4", "False", (2, 3), members=2)),
        ]
        for read, data in cases:
            with self.subTest(data[:40]), self.assertRaises(image_files.format_error):
                read(data)

    def test_truth_is_sampled_at_pixel_centres(self):
        # 8 pixels to 3: centres at 1.33, 4, 6.67 of the source's coordinates; 0 = unknown becomes infinity.
        image = (8, 1, 1, bytes([1, 16, 3, 4, 8, 6, 0, 9]))
        self.assertEqual(image_files.scale_truth(image, 3, 8), (3, 1, array.array("f", [6.0, 3.0, math.inf])))
        with self.assertRaises(image_files.format_error):
            image_files.scale_truth((1, 1, 3, bytes(3)), 3, 8)


if __name__ == "__main__":
    unittest.main()
