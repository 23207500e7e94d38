"""A network namespace for each node of a cluster, which a pair of veth connects with this machine. It needs root.

The namespaces have no names: they are those of a sleeping process, and vanish with it however these tests end.
"""

import os
import subprocess

from processes import Failed, start, wait_for


class Network:
    """Namespaces of some nodes; `with Network(…)` makes them. slurmctld listens on `outside`."""

    def __init__(self, nodes, folder):
        # blocks that are reserved for documentation, and a part of one that nothing here uses
        taken = run("ip", "-4", "-oneline", "address") + run("ip", "-4", "route")
        parts = [f"{block}.{part}" for block in ("198.51.100", "203.0.113") if f" {block}.0/24" not in taken for part in range(0, 256, 8)]
        first = os.getpid() % len(parts) if parts else 0  # tests that begin at the same time take different ones
        part = next((part for part in parts[first:] + parts[:first] if f" {part}/" not in taken), None)
        if part is None:
            raise Failed("all addresses for the nodes are in use")
        block, _, first = part.rpartition(".")
        here = [f"{block}.{int(first) + 4 * i + 1}" for i in range(len(nodes))]
        there = [f"{block}.{int(first) + 4 * i + 2}" for i in range(len(nodes))]
        self.folder, self.outside, self.pairs = folder, here[0], dict(zip(nodes, zip(here, there)))
        self.holders = {}

    def __enter__(self):
        own = os.stat("/proc/self/ns/net").st_ino
        for node, (here, there) in self.pairs.items():
            holder = start(["unshare", "--net", "sleep", "infinity"], self.folder / f"network-{node}.out")
            self.holders[node] = holder
            wait_for("a namespace", lambda: holder.poll() is not None or os.stat(f"/proc/{holder.pid}/ns/net").st_ino != own, 5)
            if holder.poll() is not None:
                raise Failed(f"unshare --net: exit status {holder.returncode}")
            inside = ["nsenter", f"--net=/proc/{holder.pid}/ns/net"]
            run("ip", "link", "add", self.link(node), "type", "veth", "peer", "name", "veth0", "netns", str(holder.pid))
            run("ip", "address", "add", f"{here}/30", "dev", self.link(node))
            run("ip", "link", "set", self.link(node), "up")
            run(*inside, "ip", "address", "add", f"{there}/30", "dev", "veth0")
            for name in "lo", "veth0":
                run(*inside, "ip", "link", "set", name, "up")
            run(*inside, "ip", "route", "add", "default", "via", here)
        return self

    def __exit__(self, *_):
        for holder in self.holders.values():
            holder.kill()
            holder.wait()

    def link(self, node):
        """The name of a node's interface on this machine, at most 15 characters."""
        return f"v{os.getpid()}-{node}"

    def address(self, node):
        return self.pairs[node][1]

    def inside(self, node):
        """What goes before a command to run it in a node's namespace."""
        return ["nsenter", f"--net=/proc/{self.holders[node].pid}/ns/net"]

    def cut(self, node):
        """Takes a node's network away; its processes go on."""
        run("ip", "link", "set", self.link(node), "down")

    def mend(self, node):
        run("ip", "link", "set", self.link(node), "up")


def run(*command):
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode != 0:
        raise Failed(f"{' '.join(command)}: {done.stderr.strip()}")
    return done.stdout
