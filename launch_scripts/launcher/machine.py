"""What the machine gave to a session."""
import pathlib

# /proc/stat, "cpu": user nice system idle iowait irq softirq steal; what follows is part of user and nice
STEAL, COUNTED = 7, 8


def processor_times(text):
    """(stolen, all) of all processors since the start of the machine, in ticks; `text`: of /proc/stat."""
    fields = [int(field) for field in text.split("\n", 1)[0].split()[1:1 + COUNTED]]
    return (fields[STEAL] if len(fields) == COUNTED else 0), sum(fields)


class StealWatch:
    """The share of the processors' time that a hypervisor gave to others since this object was made."""

    def __init__(self, file=pathlib.Path("/proc/stat")):
        self.file = file
        self.begin = processor_times(file.read_text(encoding="ascii"))

    def share(self):
        stolen, total = (now - then for now, then in zip(processor_times(self.file.read_text(encoding="ascii")), self.begin))
        return stolen / total if total > 0 else 0.0
