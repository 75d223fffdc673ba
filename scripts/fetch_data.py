#!/usr/bin/env python3
"""Fetches stereo pairs with ground truth into data/downloads, as data/pairs.json says, and verifies every file.

  scripts/fetch_data.py                 the scenes that Debian's packages carry (no other network is needed)
  scripts/fetch_data.py venus cones     these scenes
  scripts/fetch_data.py --all           every scene of the manifest (most come from Middlebury's own site)
  scripts/fetch_data.py --offline ...   downloads nothing: verifies what is there
  scripts/fetch_data.py --list          what there is, and from where

A file that is there already and has the right SHA-256 is not fetched again. A file appears under its name only after
its check sum was found right. Debian packages are downloaded and unpacked, never installed. Only Python's standard
library is used. See docs/data.md.
"""

import argparse
import contextlib
import glob
import hashlib
import http.client
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import urllib.error
import urllib.parse
import urllib.request
import zipfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import image_files  # noqa: E402  (stands beside this file)

root = pathlib.Path(__file__).resolve().parent.parent
# The Aloe pair of opencv-doc is 1282 x 1110 pixels with disparities up to 211: more than the designs' 1024 columns and
# 80 levels. Three eighths of it (481 x 417, disparities up to 79.1) fit, and djpeg scales by eighths while decoding.
jpeg_scale = (3, 8)


class fetch_error(Exception):
    """One sentence for the person at the terminal: what failed, and what to do."""


def sha256_of(data):
    return hashlib.sha256(data).hexdigest()


def load_manifest(path):
    try:
        scenes = json.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise fetch_error(f"cannot read the manifest {path}: {error.strerror}") from error
    except json.JSONDecodeError as error:
        raise fetch_error(f"the manifest {path} is not valid JSON: {error}") from error
    for scene in scenes:
        if scene["files"].keys() != scene["sources"].keys():
            raise fetch_error(f"the manifest {path} names different files in 'files' and 'sources' of {scene['scene']}")
    return scenes


def run(command, folder, what, environment=None):
    """Runs a program; its own words are shown only if it fails."""
    try:
        return subprocess.run(
            command, cwd=folder, env=environment, check=True, stdin=subprocess.DEVNULL, capture_output=True
        ).stdout
    except FileNotFoundError as error:
        raise fetch_error(f"{what}: the program '{command[0]}' was not found (it comes with Debian)") from error
    except subprocess.CalledProcessError as error:
        words = error.stderr.decode(errors="replace").strip() or f"exit code {error.returncode}"
        raise fetch_error(f"{what} failed: {words}") from error


class fetcher:
    """Gets source files; keeps each downloaded package or archive for the scenes that follow, in `folder`."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        self.packages = {}
        self.downloads = {}

    def package(self, name):
        """The folder into which Debian's package `name` was unpacked."""
        if name not in self.packages:
            print(f"  downloading Debian package {name}", flush=True)
            debs = self.folder / f"{name}-deb"
            files = self.folder / name
            debs.mkdir()
            try:
                run(["apt-get", "-q", "download", name], debs, f"downloading Debian package {name}")
            except fetch_error as error:
                raise fetch_error(f"{error}\n(if apt knows no such package, run 'apt-get update' as root first)") from error
            deb = glob.glob(str(debs / "*.deb"))
            if len(deb) != 1:
                raise fetch_error(f"'apt-get download {name}' left {len(deb)} packages instead of one")
            run(["dpkg", "-x", deb[0], str(files)], self.folder, f"unpacking Debian package {name}")
            shutil.rmtree(debs)
            self.packages[name] = files
        return self.packages[name]

    def url(self, address):
        if address not in self.downloads:
            print(f"  downloading {address}", flush=True)
            try:
                with urllib.request.urlopen(address, timeout=60) as response:
                    self.downloads[address] = response.read()
            except urllib.error.HTTPError as error:
                raise fetch_error(f"cannot download {address}: the server answered {error.code} {error.reason}") from error
            except (OSError, http.client.HTTPException) as error:
                raise fetch_error(f"cannot download {address}: {getattr(error, 'reason', error)}") from error
        return self.downloads[address]

    def read(self, source):
        """The bytes of a manifest's source, as they are at their origin."""
        if "package" in source:
            path = self.package(source["package"]) / source["path"]
            try:
                return path.read_bytes()
            except OSError as error:
                raise fetch_error(
                    f"Debian package {source['package']} holds no {source['path']}: {error.strerror}"
                ) from error
        data = self.url(source["url"])
        if "member" in source:
            archive = self.folder / "archive.zip"
            archive.write_bytes(data)
            try:
                with zipfile.ZipFile(archive) as members:
                    return members.read(source["member"])
            except (KeyError, zipfile.BadZipFile) as error:
                raise fetch_error(f"{source['url']} holds no {source['member']}: {error}") from error
        return data

    def decode_jpeg(self, data):
        """A JPEG file, scaled by jpeg_scale, as PPM. The decoder is Debian's own, so the pixels are always the same."""
        program = self.package("libjpeg-turbo-progs") / "usr/bin/djpeg"
        library = glob.glob(str(self.package("libjpeg62-turbo") / "usr/lib/*/libjpeg.so.62"))
        if len(library) != 1:
            raise fetch_error("Debian package libjpeg62-turbo holds no libjpeg.so.62")
        image = self.folder / "image.jpg"
        image.write_bytes(data)
        environment = dict(os.environ, LD_LIBRARY_PATH=os.path.dirname(library[0]))
        scale = "{}/{}".format(*jpeg_scale)
        return run([str(program), "-pnm", "-scale", scale, str(image)], self.folder, "decoding a JPEG", environment)

    def convert(self, data, conversion):
        """From the origin's format to the one the manifest promises; None = as it is."""
        if conversion is None:
            return data
        if conversion == "pnm":
            return image_files.write_pnm(image_files.read_image(data))
        if conversion == "pfm":
            return image_files.write_pfm(image_files.read_pfm(data))
        if conversion == "npz to pfm":
            return image_files.write_pfm(image_files.read_npz(data))
        if conversion == "jpeg to scaled ppm":
            return self.decode_jpeg(data)
        if conversion == "truth to scaled pfm":
            return image_files.write_pfm(image_files.scale_truth(image_files.read_image(data), *jpeg_scale))
        raise fetch_error(f"the manifest asks for an unknown conversion '{conversion}'")

    def fetch(self, source):
        try:
            return self.convert(self.read(source), source.get("convert"))
        except image_files.format_error as error:
            raise fetch_error(f"{source.get('path') or source.get('url')}: {error}") from error


def write_whole(path, data):
    """Writes a file so that it is either there in full or not at all."""
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        handle, temporary = tempfile.mkstemp(prefix=".part-", dir=path.parent)
        try:
            with os.fdopen(handle, "wb") as out:
                out.write(data)
            os.chmod(temporary, 0o644)
            os.replace(temporary, path)
        except BaseException:
            with contextlib.suppress(FileNotFoundError):
                os.unlink(temporary)
            raise
    except OSError as error:
        raise fetch_error(f"cannot write {path}: {error.strerror}") from error


def state_of(path, expected):
    """'good', 'missing' or 'wrong'."""
    try:
        return "good" if sha256_of(path.read_bytes()) == expected else "wrong"
    except FileNotFoundError:
        return "missing"
    except OSError as error:
        raise fetch_error(f"cannot read {path}: {error.strerror}") from error


def fetch_scene(scene, folder, origin, offline):
    print(f"{scene['scene']}:", flush=True)
    fetched = verified = 0
    for name, expected in scene["files"].items():
        path = folder / scene["scene"] / name
        state = state_of(path, expected)
        if state == "good":
            verified += 1
            continue
        if offline and state == "missing" and scene["sources"][name].get("optional"):
            continue
        if offline:
            said = "is missing" if state == "missing" else "has a wrong SHA-256"
            raise fetch_error(f"{path} {said}; run scripts/fetch_data.py {scene['scene']} where there is a network")
        source = scene["sources"][name]
        try:
            data = origin.fetch(source)
            found = sha256_of(data)
            if found != expected:
                raise fetch_error(
                    f"{scene['scene']}/{name} from {describe(source)} has a wrong SHA-256:\n"
                    f"  expected {expected}\n  found    {found}\nIt was not kept."
                )
        except fetch_error as error:
            if not source.get("optional"):
                raise
            print(f"  going on without the optional {name}: {error}", flush=True)
            continue
        write_whole(path, data)
        fetched += 1
    print(f"  {verified + fetched} files verified, {fetched} of them new: {folder / scene['scene']}", flush=True)


def write_list_of_complete_scenes(scenes, folder):
    """downloads/pairs.json: the scenes that are there in full (but for optional files), for programs that read it."""
    complete = []
    for scene in scenes:
        good = {
            name: digest for name, digest in scene["files"].items() if state_of(folder / scene["scene"] / name, digest) == "good"
        }
        if all(name in good or scene["sources"][name].get("optional") for name in scene["files"]):
            complete.append({key: value for key, value in scene.items() if key != "sources"} | {"files": good})
    if complete:
        write_whole(folder / "pairs.json", (json.dumps(complete, indent=1) + "\n").encode())


def describe(source):
    return f"Debian package {source['package']}" if "package" in source else source["url"]


def origin_of(source):
    """Shorter than describe(): for an address its host only."""
    return describe(source) if "package" in source else urllib.parse.urlsplit(source["url"]).netloc


def from_debian(scene):
    return all("package" in source for source in scene["sources"].values())


def choose(scenes, names, everything):
    if everything:
        return scenes
    if not names:
        return [scene for scene in scenes if from_debian(scene)]
    known = {scene["scene"]: scene for scene in scenes}
    for name in names:
        if name not in known:
            raise fetch_error(f"unknown scene '{name}' (known: {', '.join(known)})")
    return [known[name] for name in names]


def main(arguments):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scenes", nargs="*", metavar="SCENE")
    parser.add_argument("--all", action="store_true", help="every scene of the manifest")
    parser.add_argument("--offline", action="store_true", help="download nothing, verify what is there")
    parser.add_argument("--list", action="store_true", help="print the scenes and where they come from")
    parser.add_argument("--to", type=pathlib.Path, default=root / "data" / "downloads", metavar="FOLDER")
    parser.add_argument("--manifest", type=pathlib.Path, default=root / "data" / "pairs.json", metavar="FILE")
    options = parser.parse_args(arguments)
    try:
        scenes = load_manifest(options.manifest)
        if options.list:
            for scene in scenes:
                origins = sorted({origin_of(source) for source in scene["sources"].values()})
                print(f"{scene['scene']}: {scene['family']}; {scene['levels']} levels; from {', '.join(origins)}")
            return 0
        chosen = choose(scenes, options.scenes, options.all)
        with tempfile.TemporaryDirectory(prefix="epiline-fetch-") as temporary:
            origin = fetcher(temporary)
            for scene in chosen:
                fetch_scene(scene, options.to, origin, options.offline)
        write_list_of_complete_scenes(scenes, options.to)
    except fetch_error as error:
        print(f"fetch_data.py: error: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
