"""Bakes of one scene with one set of options: what the scripts of this folder start, kill and compare."""
import os
import re
import shlex
import subprocess
import sys
import time

SMALL = '--texel 5cm --error 5% --object "tall block:mover" --probe 50cm'  # two seconds of the Cornell box


def add_arguments(parser):
    parser.add_argument("bin", help="folder of oriel-bake and oriel-scenes")
    parser.add_argument("--scene", help="a scene file, or a sample scene's name", default="cornell")
    parser.add_argument("--bake", default=SMALL, help="options of oriel-bake")


def count(folder, ending):
    return sum(name.endswith(ending) for _, _, names in os.walk(folder) for name in names)


def wait_until(done):
    while not done():
        time.sleep(0.002)


class Bakes:
    def __init__(self, args, folder, threads):
        self.bin, self.folder, self.threads = args.bin, folder, threads
        self.options = shlex.split(args.bake)
        self.scene = os.path.abspath(args.scene)
        if not os.path.exists(self.scene):
            self.scene = self.at(args.scene + ".glb")
            subprocess.run([self.tool("oriel-scenes"), args.scene, "-o", self.scene], check=True,
                           stdout=subprocess.DEVNULL)

    def at(self, name):
        return os.path.join(self.folder, name)

    def tool(self, name):
        return os.path.abspath(os.path.join(self.bin, name))

    def command(self, *words):
        return [self.tool("oriel-bake"), *words, "--threads", str(self.threads), *self.options]

    def start(self, *more):
        """A bake of pack.oriel, not there before: what is up to date is not baked."""
        if os.path.exists(self.at("pack.oriel")):
            os.remove(self.at("pack.oriel"))
        return subprocess.Popen(self.command(self.scene, "-o", self.at("pack.oriel"), "--quiet", *more))

    def finish(self, *more):
        """The pack's bytes and the seconds that its bake took."""
        start = time.monotonic()
        if self.start(*more).wait() != 0:
            sys.exit("a bake failed")
        return self.pack(), time.monotonic() - start

    def pack(self):
        with open(self.at("pack.oriel"), "rb") as pack:
            return pack.read()


def computed(log):
    """Units that a bake or worker computed, by what it said at its end."""
    found = re.search(r"reused (\d+) of (\d+) units", log)
    return int(found[2]) - int(found[1]) if found else None
