#!/usr/bin/env python3
"""Prints the arguments with which `epiline match` and `epiline compare` run a scene of a folder of pairs, one a line.

  mapfile -t pair < <(scripts/pair_arguments.py ../shared/data teddy)
  build/bin/epiline match --engine native "${pair[@]}"

FOLDER holds a pairs.json (scripts/fetch_data.py makes data/downloads one) and a folder a scene. Without a scene the
names of the scenes are printed.
"""

import json
import pathlib
import sys


def find(folder, names, stem):
    """The path of the scene's file `stem`.*, or None."""
    return next((str(folder / name) for name in names if name.rsplit(".", 1)[0] == stem), None)


def arguments_of(folder, scene):
    names = sorted(scene["files"])
    place = folder / scene["scene"]
    arguments = [find(place, names, "left"), find(place, names, "right"), "--levels", str(scene["levels"])]
    truth = find(place, names, "disp_left")
    if truth:
        arguments += ["--truth", truth]
        if scene["truth_scale"]:
            arguments += ["--truth-scale", str(scene["truth_scale"])]
        mask = find(place, names, "mask_all")
        not_occluded = find(place, names, "mask_nonocc") or find(place, names, "mask_nonocc_left")
        arguments += ["--mask", mask] if mask else []
        arguments += ["--mask-nonocc", not_occluded] if not_occluded else []
        discontinuities = find(place, names, "mask_disc")
        arguments += ["--mask-disc", discontinuities] if discontinuities else []
    return arguments


def main(arguments):
    if len(arguments) not in (1, 2):
        print(__doc__.strip(), file=sys.stderr)
        return 2
    folder = pathlib.Path(arguments[0])
    try:
        scenes = {scene["scene"]: scene for scene in json.loads((folder / "pairs.json").read_text(encoding="utf-8"))}
    except (OSError, ValueError) as error:
        print(f"pair_arguments.py: error: cannot read {folder / 'pairs.json'}: {error}", file=sys.stderr)
        return 1
    if len(arguments) == 1:
        print("\n".join(scenes))
        return 0
    if arguments[1] not in scenes:
        print(f"pair_arguments.py: error: {folder} has no scene '{arguments[1]}' (it has {', '.join(scenes)})", file=sys.stderr)
        return 1
    print("\n".join(arguments_of(folder, scenes[arguments[1]])))
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
