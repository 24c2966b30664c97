#!/usr/bin/env python3
"""Stops runs at random, lets them go on, and compares what comes out with an undisturbed run, bit for bit.

    ./dev torture [KILLS] [SEED]      or   tests/torture/torture.py --program build/release/app/spall

Each trial hits a run of spall calibrate, impact, study or test once to three times: a signal, a power cut between writing and
renaming (or elsewhere: power_cut.c), a full disk, a read-only disk; or a run over the folder of a finished one is hit in such a
way, and must not leave the earlier result beside anything newer. After each hit every file must be whole and the exit code
right; --resume then goes on to the end. Prints a table and "survived N of M".
"""
import argparse
import os
import random
import shlex
import shutil
import signal
import subprocess
import sys
import tempfile
import time

import cases as all_cases
import folder as checks

HERE = os.path.dirname(os.path.abspath(__file__))
KINDS = ["SIGINT", "SIGTERM", "SIGKILL", "power cut", "full disk", "read-only"]
RERUN = "rerun"  # over the folder of a finished run, hit in one of these ways
CUTS = ["rename", "flushed", "open", "write"]
LONGEST = 600


class Outcome:
    def __init__(self, code, said, seconds):
        self.code, self.said, self.seconds = code, said, seconds


class Trial:
    """One case in a folder of its own."""

    def __init__(self, spall, shim, case, where):
        self.spall, self.shim, self.case, self.where = spall, shim, case, where
        os.makedirs(where)
        self.out = os.path.join(where, "out")
        for name, content in case.files.items():
            open(os.path.join(where, name), "w").write(content)
        self.history = []

    def environment(self, **more):
        interval = {"SPALL_CHECKPOINT_SECONDS": self.case.interval} if self.case.interval else {}
        return dict(os.environ, OMP_NUM_THREADS="1", **interval, **more)

    def shimmed(self, **more):
        return self.environment(LD_PRELOAD=self.shim, SPALL_TORTURE_FOLDER=self.out, **more)

    def words(self, resume):
        return [self.spall, *self.case.command, "-o", self.out, "--threads", "1", "--quiet"] + (["--resume"] if resume else [])

    def run(self, words, environment, hit=None):
        start = time.monotonic()
        with open(self.where + ".err", "w+") as said:
            child = subprocess.Popen(words, cwd=self.where, env=environment, stdout=subprocess.DEVNULL, stderr=said)
            if hit is not None:
                after, how = hit
                try:
                    child.wait(after)
                except subprocess.TimeoutExpired:
                    child.send_signal(how)
            try:
                child.wait(LONGEST)
            except subprocess.TimeoutExpired:
                child.kill()
                child.wait()
            said.seek(0)
            return Outcome(child.returncode, said.read(), time.monotonic() - start)

    def prepare(self):
        for command in self.case.before:
            subprocess.run([self.spall, *command], cwd=self.where, env=self.environment(), check=True)

    # How it is hit. Each returns the outcome and what is wrong with it, or None.

    def by_signal(self, name, seconds, resume):
        before = checks.stamps(self.out)
        outcome = self.run(self.words(resume), self.environment(), (seconds, getattr(signal, name)))
        number = getattr(signal, name)
        if outcome.code in self.case.done:
            return outcome, None
        if name == "SIGKILL":
            return outcome, None if outcome.code == -signal.SIGKILL else f"exit code {outcome.code}: {outcome.said}"
        if outcome.code == -number:  # before it has read its command line, and so before it has touched anything
            return outcome, None if checks.stamps(self.out) == before else f"died of {name}"
        if outcome.code != 3:
            return outcome, f"exit code {outcome.code} after {name}: {outcome.said}"
        if outcome.said.count("\n") != 1:
            return outcome, f"not one line: {outcome.said!r}"
        # Before there is anything to keep there is no command to give.
        kept = [n for n in checks.files_in(self.out) if "checkpoint" in n and not n.startswith(".")] if os.path.isdir(self.out) else []
        if kept and "--resume" not in outcome.said:
            return outcome, f"no command to go on: {outcome.said}"
        return outcome, None

    def by_power_cut(self, cut, resume):
        outcome = self.run(self.words(resume), self.shimmed(SPALL_TORTURE_CUT=cut))
        right = outcome.code in (-signal.SIGKILL, *self.case.done)
        return outcome, None if right else f"exit code {outcome.code} after {cut}: {outcome.said}"

    def failed_rightly(self, outcome, reason):
        if outcome.code in self.case.done:
            return None
        if outcome.code != 1:
            return f"exit code {outcome.code}, not 1: {outcome.said}"
        if outcome.said.count("\n") != 1 or not outcome.said.startswith("spall"):
            return f"not one line: {outcome.said!r}"
        if reason not in outcome.said and "disk full" not in outcome.said:
            return f"does not give the reason: {outcome.said}"
        return None

    def by_shim(self, resume, reason, **what):
        outcome = self.run(self.words(resume), self.shimmed(**what))
        return outcome, self.failed_rightly(outcome, reason)

    def in_own_mounts(self, script):
        """Runs a shell's script with mounts that nobody else sees."""
        return self.run(["unshare", "-m", "sh", "-c", script], self.environment())

    def take_finished(self, reference):
        """The folder of the finished run, to run over it; a study's without its tasks, or there is nothing to do."""
        shutil.copytree(reference.out, self.out)
        shutil.rmtree(os.path.join(self.out, "tasks"), ignore_errors=True)
        checks.age(self.out)

    def by_small_disk(self, size, resume):
        """A small tmpfs in place of the folder, its content copied there and back."""
        out, kept = shlex.quote(self.out), shlex.quote(self.out + ".kept")
        there = sum(os.path.getsize(p) for p in checks.files_in(self.out).values()) if os.path.isdir(self.out) else 0
        kilobytes = 4 * len(checks.files_in(self.out)) + (there + size) // 1024 + 16
        outcome = self.in_own_mounts(
            f"mkdir -p {out} {kept} && mount -t tmpfs -o size={kilobytes}k none {kept} && cp -a {out}/. {kept}/ && "
            f"mount --move {kept} {out} || exit 99\n"
            f"{shlex.join(self.words(resume))}; code=$?\n"
            f"cp -a {out}/. {kept}/ && umount {out} && rm -rf {out} && mv {kept} {out}; exit $code")
        shutil.rmtree(self.out + ".kept", ignore_errors=True)
        return outcome, self.failed_rightly(outcome, "No space left")

    def by_read_only_mount(self, resume):
        out = shlex.quote(self.out)
        outcome = self.in_own_mounts(
            f"mkdir -p {out} && mount --bind {out} {out} && mount -o remount,bind,ro {out} || exit 99\n"
            f"exec {shlex.join(self.words(resume))}")
        return outcome, self.failed_rightly(outcome, "Read-only")

    def hit(self, kind, chance, reference, resume, mounts):
        if kind.startswith("SIG"):
            seconds = chance.uniform(0, reference.seconds)
            self.history.append(f"{kind} after {seconds:.3f} s")
            return self.by_signal(kind, seconds, resume)
        if kind == "power cut":
            cut = chance.choice(CUTS)
            number = chance.randint(1, max(1, reference.counts[cut]))
            self.history.append(f"power cut, {cut}:{number}")
            return self.by_power_cut(f"{cut}:{number}", resume)
        size = chance.randint(0, reference.counts["bytes"])
        opening = chance.randint(1, max(1, reference.counts["open"]))
        by_mount = mounts and chance.random() < 0.5
        if kind == "full disk":
            self.history.append(f"full after {size} bytes" + (" (tmpfs)" if by_mount else ""))
            if by_mount:
                return self.by_small_disk(size, resume)
            return self.by_shim(resume, "No space left", SPALL_TORTURE_FULL=str(size))
        self.history.append("read-only (mount)" if by_mount else f"read-only from opening {opening}")
        if by_mount:
            return self.by_read_only_mount(resume)
        return self.by_shim(resume, "Read-only", SPALL_TORTURE_READ_ONLY=str(opening))


class Reference:
    """The undisturbed run: its folder, its time, how many calls it makes."""

    def __init__(self, spall, shim, case, where, once=False):
        self.trial = Trial(spall, shim, case, where)
        self.trial.prepare()
        if once:
            return self.count(self.trial)
        outcome = self.trial.run(self.trial.words(False), self.trial.environment())
        if outcome.code not in case.done:
            sys.exit(f"torture: the undisturbed {case.name} ends with {outcome.code}: {outcome.said}")
        self.seconds, self.out = outcome.seconds, self.trial.out
        counted = Trial(spall, shim, case, where + "-counted")
        shutil.copytree(where, counted.where, dirs_exist_ok=True, ignore=shutil.ignore_patterns("out"))
        self.count(counted)
        wrong = checks.differences(counted.out, self.out)
        if wrong:
            sys.exit(f"torture: two undisturbed runs of {case.name} differ: {wrong}")
        shutil.rmtree(counted.where)

    def count(self, counted):
        outcome = counted.run(counted.words(False), counted.shimmed(SPALL_TORTURE_COUNTS=counted.where + "/counts"))
        numbers = open(counted.where + "/counts").read().split()
        self.counts = {name: int(n) for name, n in zip([*CUTS, "bytes"], numbers)}
        self.checkpoint_seconds, self.checkpoints = float(numbers[5]), int(numbers[6])
        self.run_seconds = outcome.seconds


def run_trial(trial, kind, chance, reference, mounts):
    """What went wrong, in words; None if the run survived."""
    for name in os.listdir(reference.trial.where):
        if name.endswith(".h5"):
            shutil.copy(os.path.join(reference.trial.where, name), trial.where)
    resume = False
    if kind == RERUN:
        trial.take_finished(reference)
        trial.history.append("over a finished run")
    for number in range(chance.choice([1, 1, 2, 3])):
        how = kind if number == 0 and kind != RERUN else chance.choice(KINDS)
        outcome, wrong = trial.hit(how, chance, reference, resume, mounts)
        if wrong:
            return wrong
        broken = checks.faults(trial.out, trial.spall) if os.path.isdir(trial.out) else []
        beside = checks.fault_of_rerun(trial.out) if kind == RERUN and outcome.code not in trial.case.done else None
        if beside:
            return beside
        if broken:
            return "; ".join(broken)
        if outcome.code in trial.case.done:
            break
        resume = True
    outcome = trial.run(trial.words(True), trial.environment())
    if outcome.code not in trial.case.done:
        return f"does not go on, exit code {outcome.code}: {outcome.said}"
    wrong = checks.faults(trial.out, trial.spall) + checks.differences(trial.out, reference.out)
    wrong += [f"{name} lies about" for name in checks.left_overs(trial.out)]
    return "; ".join(wrong) or None


def may_mount(where):
    script = f"mount --bind {shlex.quote(where)} {shlex.quote(where)}"
    return subprocess.run(["unshare", "-m", "sh", "-c", script], capture_output=True).returncode == 0


def print_cost(spall, shim, where):
    """What the checkpoints cost, at sizes where it matters more than in the small runs."""
    for case in all_cases.long_cases():
        reference = Reference(spall, shim, case, os.path.join(where, "cost-" + case.name), once=True)
        each = reference.checkpoint_seconds / max(1, reference.checkpoints)
        line = (f"checkpoint cost: {case.name}, {reference.checkpoints} in {reference.run_seconds:.1f} s, {1e3 * each:.1f} ms each"
                f"{', every ' + case.interval + ' s' if case.interval else ''}: "
                f"{100 * reference.checkpoint_seconds / reference.run_seconds:.3f}% of the run's time")
        if case.interval:
            line += f"; as usual, every {case.usual:g} s: {100 * each / max(case.usual, 200 * each):.3f}%"
        print(line, flush=True)


def print_table(names, tried, survived):
    print(f"\n{'run':<12}" + "".join(f"{kind:>12}" for kind in [*KINDS, RERUN]))
    for name in names:
        cells = [f"{survived.get((name, kind), 0)}/{tried[name, kind]}" if (name, kind) in tried else "-" for kind in [*KINDS, RERUN]]
        print(f"{name:<12}" + "".join(f"{cell:>12}" for cell in cells))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("kills", nargs="?", type=int, default=100)
    parser.add_argument("seed", nargs="?", type=int, default=1)
    parser.add_argument("--program", default="build/release/app/spall")
    parser.add_argument("--runs", default="calibrate,impact,study,test", help="which of them")
    parser.add_argument("--long", action="store_true", help="larger runs, more than ten seconds each")
    parser.add_argument("--cost", action="store_true", help="only say what checkpoints cost")
    parser.add_argument("--folder", help="to work in; kept (default: a temporary one, kept if a run does not survive)")
    options = parser.parse_args()
    spall = os.path.abspath(options.program)
    where = os.path.abspath(options.folder) if options.folder else tempfile.mkdtemp(prefix="spall-torture-")
    os.makedirs(where, exist_ok=True)
    shim = os.path.join(where, "power_cut.so")
    subprocess.run(["cc", "-std=c11", "-O1", "-shared", "-fPIC", os.path.join(HERE, "power_cut.c"), "-o", shim, "-ldl"], check=True)
    mounts = may_mount(where)
    if not mounts:
        print("mounting is not permitted here: full and read-only disks by power_cut.c alone")

    if options.cost:
        return print_cost(spall, shim, where)
    wanted = [case for case in (all_cases.long_cases() if options.long else all_cases.cases()) if case.name in options.runs.split(",")]
    references = {}
    for case in wanted:
        made = references[case.name] = Reference(spall, shim, case, os.path.join(where, case.name))
        print(f"{case.name}: undisturbed in {made.seconds:.2f} s, {made.counts['open']} files written, "
              f"{made.checkpoints} checkpoints of {1e3 * made.checkpoint_seconds / max(1, made.checkpoints):.1f} ms each", flush=True)

    chance = random.Random(options.seed)
    tried, survived, lost = {}, {}, []
    plan = [(case, kind) for kind in [*KINDS, RERUN] for case in wanted]
    chance.shuffle(plan)
    for number in range(options.kills):
        case, kind = plan[number % len(plan)]
        trial = Trial(spall, shim, case, os.path.join(where, f"{number + 1:04d}-{case.name}"))
        wrong = run_trial(trial, kind, chance, references[case.name], mounts)
        tried[case.name, kind] = tried.get((case.name, kind), 0) + 1
        if wrong:
            lost.append(trial.where)
            print(f"{case.name}, {', then '.join(trial.history)}: {wrong}\n  left in {trial.where}", flush=True)
        else:
            survived[case.name, kind] = survived.get((case.name, kind), 0) + 1
            shutil.rmtree(trial.where)
            os.remove(trial.where + ".err")
    print_table([case.name for case in wanted], tried, survived)
    if not lost and not options.folder:
        shutil.rmtree(where)
    print(f"\nsurvived {options.kills - len(lost)} of {options.kills}")
    return 1 if lost else 0


if __name__ == "__main__":
    sys.exit(main())
