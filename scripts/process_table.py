"""What the kernel knows about processes."""
import os


def status(pid):
    """Fields of /proc/PID/stat from the third on."""
    with open(f'/proc/{pid}/stat') as file:
        return file.read().rpartition(')')[2].split()


def children(pid):
    found = []
    for name in filter(str.isdigit, os.listdir('/proc')):
        try:
            if int(status(name)[1]) == pid:
                found.append(int(name))
        except (FileNotFoundError, ProcessLookupError):
            pass
    return found


def program(pid):
    """Path of what it runs; empty: it has ended."""
    try:
        with open(f'/proc/{pid}/cmdline') as file:
            return file.read().split('\0')[0]
    except (FileNotFoundError, ProcessLookupError):
        return ''


def started(pid):
    return int(status(pid)[19]) / os.sysconf('SC_CLK_TCK')


def resident(pid):
    """Megabytes."""
    with open(f'/proc/{pid}/statm') as file:
        return int(file.read().split()[1]) * os.sysconf('SC_PAGESIZE') / 1e6


def descriptors(pid):
    return len(os.listdir(f'/proc/{pid}/fd'))


def threads(pid):
    return int(status(pid)[17])
