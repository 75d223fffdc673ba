"""scripts/fetch_data.py as a person runs it, with manifests whose sources are made here: no network is used."""

import hashlib
import http.server
import json
import os
import pathlib
import stat
import subprocess
import sys
import tempfile
import threading
import unittest
import zipfile

script = pathlib.Path(__file__).resolve().parents[2] / "scripts" / "fetch_data.py"
picture = b"P5\n2 1\n255\nab"
picture_with_comment = b"P5\n# a comment\n2 1\n255\nab"


class small_server(http.server.BaseHTTPRequestHandler):
    """On this machine only: one picture, one that ends too early, and nothing else."""

    def do_GET(self):
        if self.path not in ("/whole.pgm", "/short.pgm"):
            self.send_error(404)
            return
        self.send_response(200)
        self.send_header("Content-Length", str(len(picture) + (5 if self.path == "/short.pgm" else 0)))
        self.end_headers()
        self.wfile.write(picture)

    def log_message(self, *_):
        pass


def sha256(data):
    return hashlib.sha256(data).hexdigest()


class fetch_data(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)
        self.downloads = self.folder / "downloads"
        self.origin = self.folder / "origin.pgm"
        self.origin.write_bytes(picture_with_comment)
        self.source = {"url": self.origin.as_uri(), "convert": "pnm"}

    def scene(self, digest=sha256(picture), source=None, name="left.pgm"):
        return {
            "scene": "small",
            "family": "made here",
            "levels": 16,
            "truth_scale": None,
            "files": {name: digest},
            "sources": {name: source or self.source},
        }

    def run_script(self, scenes, *arguments, path=None):
        manifest = self.folder / "manifest.json"
        manifest.write_text(scenes if isinstance(scenes, str) else json.dumps(scenes))
        environment = dict(os.environ, no_proxy="127.0.0.1")
        if path is not None:
            environment["PATH"] = f"{path}:{environment['PATH']}"
        return subprocess.run(
            [sys.executable, "-B", str(script), "--manifest", str(manifest), "--to", str(self.downloads), *arguments],
            capture_output=True,
            text=True,
            env=environment,
            check=False,
        )

    def assert_refused(self, result, *words):
        self.assertEqual(result.returncode, 1, result.stderr)
        self.assertIn("fetch_data.py: error: ", result.stderr)
        self.assertNotIn("Traceback", result.stderr)
        for word in words:
            self.assertIn(word, result.stderr)

    def assert_nothing_is_left(self):
        left = [path for path in self.downloads.rglob("*") if path.is_file()] if self.downloads.exists() else []
        self.assertEqual(left, [])

    def test_a_file_is_fetched_converted_verified_and_listed(self):
        result = self.run_script([self.scene()], "small")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual((self.downloads / "small/left.pgm").read_bytes(), picture)
        listed = json.loads((self.downloads / "pairs.json").read_text())
        self.assertEqual([(scene["scene"], scene["files"]) for scene in listed], [("small", {"left.pgm": sha256(picture)})])
        self.assertNotIn("sources", listed[0])

    def test_a_good_file_is_not_fetched_again(self):
        self.run_script([self.scene()], "small")
        self.origin.unlink()
        result = self.run_script([self.scene()], "small")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("1 files verified, 0 of them new", result.stdout)

    def test_a_damaged_file_is_fetched_again(self):
        self.run_script([self.scene()], "small")
        (self.downloads / "small/left.pgm").write_bytes(picture[:-1])
        self.assertEqual(self.run_script([self.scene()], "small").returncode, 0)
        self.assertEqual((self.downloads / "small/left.pgm").read_bytes(), picture)

    def test_a_wrong_check_sum_is_refused_and_the_file_not_kept(self):
        result = self.run_script([self.scene(digest="0" * 64)], "small")
        self.assert_refused(result, "small/left.pgm", "wrong SHA-256", "0" * 64, sha256(picture))
        self.assert_nothing_is_left()

    def test_a_missing_origin_is_named(self):
        self.origin.unlink()
        self.assert_refused(self.run_script([self.scene()], "small"), "cannot download", self.origin.as_uri())
        self.assert_nothing_is_left()

    def test_a_truncated_image_is_refused(self):
        self.origin.write_bytes(picture[:-1])
        self.assert_refused(self.run_script([self.scene()], "small"), "truncated PNM")
        self.assert_nothing_is_left()

    def test_a_web_server_is_asked_and_its_failures_are_told(self):
        server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), small_server)
        self.addCleanup(server.server_close)
        threading.Thread(target=server.serve_forever, daemon=True).start()
        self.addCleanup(server.shutdown)
        address = f"http://127.0.0.1:{server.server_port}"
        result = self.run_script([self.scene(source={"url": f"{address}/short.pgm"})], "small")
        self.assert_refused(result, "cannot download", "short.pgm")
        self.assert_nothing_is_left()
        result = self.run_script([self.scene(source={"url": f"{address}/none.pgm"})], "small")
        self.assert_refused(result, "none.pgm", "answered 404")
        result = self.run_script([self.scene(source={"url": f"{address}/whole.pgm"})], "small")
        self.assertEqual(result.returncode, 0, result.stderr)

    def test_an_optional_file_may_be_missing(self):
        scene = self.scene()
        scene["files"]["mask.pgm"] = sha256(b"")
        scene["sources"]["mask.pgm"] = {"url": (self.folder / "none").as_uri(), "optional": True}
        result = self.run_script([scene], "small")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("without the optional mask.pgm", result.stdout)
        listed = json.loads((self.downloads / "pairs.json").read_text())
        self.assertEqual(list(listed[0]["files"]), ["left.pgm"])
        self.assertEqual(self.run_script([scene], "small", "--offline").returncode, 0)

    def test_offline_accepts_what_is_good_and_names_what_is_not(self):
        self.assert_refused(self.run_script([self.scene()], "small", "--offline"), "left.pgm is missing")
        self.run_script([self.scene()], "small")
        self.assertEqual(self.run_script([self.scene()], "small", "--offline").returncode, 0)
        (self.downloads / "small/left.pgm").write_bytes(b"damaged")
        self.assert_refused(self.run_script([self.scene()], "small", "--offline"), "left.pgm has a wrong SHA-256")

    def test_a_member_of_an_archive(self):
        archive = self.folder / "all.zip"
        with zipfile.ZipFile(archive, "w") as members:
            members.writestr("deep/left.pgm", picture)
        source = {"url": archive.as_uri(), "member": "deep/left.pgm"}
        self.assertEqual(self.run_script([self.scene(source=source)], "small").returncode, 0)
        self.assertEqual((self.downloads / "small/left.pgm").read_bytes(), picture)
        source["member"] = "deep/right.pgm"
        self.assert_refused(self.run_script([self.scene(source=source, name="right.pgm")], "small"), "deep/right.pgm")

    def test_an_unwritable_folder_is_named(self):
        self.downloads.write_text("a file stands where the folder should be")
        self.assert_refused(self.run_script([self.scene()], "small"), str(self.downloads))

    def test_bad_manifests_and_names(self):
        self.assert_refused(self.run_script([self.scene()], "other"), "unknown scene 'other'", "small")
        self.assert_refused(self.run_script("{"), "not valid JSON")
        scene = self.scene()
        scene["sources"] = {}
        self.assert_refused(self.run_script([scene], "small"), "different files")
        self.assert_refused(
            self.run_script([self.scene(source=dict(self.source, convert="magic"))], "small"), "unknown conversion 'magic'"
        )
        result = subprocess.run(
            [sys.executable, "-B", str(script), "--manifest", str(self.folder / "none.json")],
            capture_output=True, text=True, check=False,
        )
        self.assert_refused(result, "cannot read the manifest")

    def stand_in(self, name, text):
        tools = self.folder / "tools"
        tools.mkdir(exist_ok=True)
        program = tools / name
        program.write_text(f"#!/bin/sh\n{text}\n")
        program.chmod(program.stat().st_mode | stat.S_IXUSR)
        return tools

    def test_a_debian_package_is_downloaded_and_unpacked(self):
        # Stand-ins for the two programs: what is tested is how they are called and how their failures are told.
        self.stand_in("apt-get", 'test "$*" = "-q download some-package" && touch some-package_1_all.deb')
        tools = self.stand_in("dpkg", f'test "$1" = -x && mkdir -p "$3/usr" && cp {self.origin} "$3/usr/left.pgm"')
        source = {"package": "some-package", "path": "usr/left.pgm", "convert": "pnm"}
        result = self.run_script([self.scene(source=source)], path=tools)  # no names: the scenes from Debian
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual((self.downloads / "small/left.pgm").read_bytes(), picture)
        source["path"] = "usr/right.pgm"
        self.assert_refused(
            self.run_script([self.scene(source=source, name="right.pgm")], path=tools), "some-package holds no usr/right.pgm"
        )
        self.stand_in("apt-get", "echo 'E: Unable to locate package some-package' >&2; exit 100")
        self.assert_refused(
            self.run_script([self.scene(source=source, name="right.pgm")], path=tools),
            "Unable to locate package some-package", "apt-get update",
        )

    def test_the_projects_manifest_is_complete(self):
        result = subprocess.run([sys.executable, "-B", str(script), "--list"], capture_output=True, text=True, check=False)
        self.assertEqual(result.returncode, 0, result.stderr)
        scenes = json.loads((script.parents[1] / "data" / "pairs.json").read_text())
        self.assertEqual(len(result.stdout.splitlines()), len(scenes))
        for scene in scenes:
            names = {name.split(".")[0] for name in scene["files"]}
            self.assertLessEqual({"left", "right", "disp_left"}, names)
            self.assertTrue(16 <= scene["levels"] <= 128)
            for digest in scene["files"].values():
                self.assertRegex(digest, "^[0-9a-f]{64}$")


if __name__ == "__main__":
    unittest.main()
