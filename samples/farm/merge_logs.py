"""The logs of the parts of a batch (tilepack batch --log-format json) as one report, and the worst exit code as its own.

A part whose log has no last line did not come to its end: that is an error, exit code 6.
"""

import argparse
import json
import sys

ENDS = ("current", "built", "restored", "failed", "skipped")


def events(file):
    with open(file, encoding="utf-8") as stream:
        for line in stream:
            try:
                yield json.loads(line)
            except ValueError:
                return  # cut off where it was killed


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--parts", type=int, help="how many there must be")
    parser.add_argument("logs", nargs="*")
    arguments = parser.parse_args()
    total, failures, worst, whole, peak = dict.fromkeys(ENDS, 0), [], 0, 0, 0
    for log in arguments.logs:
        for event in events(log):
            peak = max(peak, event.get("peak_memory", 0))
            if event["event"] == "failed":
                failures.append(event)
                worst = max(worst, event["code"])
            if event["event"] == "end":
                whole += 1
                for end in ENDS:
                    total[end] += event[end]
    for failure in sorted(failures, key=lambda f: f["entry"]):
        print(f"failed: {failure['entry']}: {failure['message']}")
    print(", ".join(f"{count} {end}" for end, count in total.items() if count) or "nothing", f"(peak of a part {peak >> 20} MB)")
    wanted = len(arguments.logs) if arguments.parts is None else arguments.parts
    if whole < wanted:
        print(f"merge_logs: {wanted - whole} of {wanted} parts did not come to their end", file=sys.stderr)
        worst = max(worst, 6)
    return worst


if __name__ == "__main__":
    sys.exit(main())
