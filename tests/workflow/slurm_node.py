# SPDX-License-Identifier: GPL-3.0-or-later
"""A private Slurm of one node: its own munged, slurmctld and slurmd on loopback ports, ended with
the `with` block. It touches no Slurm that this machine may have."""
import contextlib
import getpass
import os
import socket
import subprocess
import time

CONFIG = """ClusterName=test
SlurmctldHost={host}(127.0.0.1)
SlurmUser={user}
SlurmdUser={user}
AuthType=auth/munge
AuthInfo=socket={folder}/munge/socket
CredType=cred/munge
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
SlurmctldPort={ports[0]}
SlurmdPort={ports[1]}
SlurmdParameters=config_overrides
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
MpiDefault=none
ReturnToService=2
NodeName={host} NodeAddr=127.0.0.1 CPUs=2 RealMemory=4000 State=UNKNOWN
PartitionName=main Nodes=ALL Default=YES MaxTime=INFINITE State=UP
"""


def free_ports(count):
    sockets = [socket.socket() for _ in range(count)]
    for s in sockets:
        s.bind(("127.0.0.1", 0))
    ports = [s.getsockname()[1] for s in sockets]
    for s in sockets:
        s.close()
    return ports


def start(words, env, log):
    """A daemon kept in the foreground, so that its process is known and can be ended."""
    with open(log, "w", encoding="utf-8") as out:
        return subprocess.Popen(words, env=env, stdout=out, stderr=out, stdin=subprocess.DEVNULL)


def wait_until_idle(env, folder):
    for _ in range(60):
        done = subprocess.run(["sinfo", "-h", "-o", "%T"], env=env, capture_output=True, text=True)
        if "idle" in done.stdout:
            return
        time.sleep(1)
    logs = ""
    for name in ("munged.out", "slurmctld.out", "slurmctld.log", "slurmd.out", "slurmd.log"):
        if os.path.exists(f"{folder}/{name}"):
            with open(f"{folder}/{name}", encoding="utf-8", errors="replace") as file:
                logs += f"--- {name}\n" + "".join(file.readlines()[-20:])
    raise RuntimeError(f"the node did not become idle: {done.stdout}{done.stderr}\n{logs}")


@contextlib.contextmanager
def slurm_node(folder):
    """Yields the environment in which sbatch and scontrol talk to the private Slurm."""
    for name in ("state", "spool", "munge"):
        os.makedirs(f"{folder}/{name}", mode=0o700)
    with open(f"{folder}/munge/key", "wb") as file:
        file.write(os.urandom(1024))
    os.chmod(f"{folder}/munge/key", 0o600)
    with open(f"{folder}/slurm.conf", "w", encoding="utf-8") as file:
        file.write(CONFIG.format(folder=folder, user=getpass.getuser(), ports=free_ports(2),
                                 host=socket.gethostname().split(".")[0]))
    env = {**os.environ, "SLURM_CONF": f"{folder}/slurm.conf",
           "PATH": "/usr/bin:/usr/sbin:/bin:/sbin"}
    munge = f"{folder}/munge"
    daemons = []
    try:
        daemons.append(start(["munged", "--foreground", "--force", f"--key-file={munge}/key",
                              f"--socket={munge}/socket", f"--pid-file={munge}/pid",
                              f"--log-file={munge}/log", f"--seed-file={munge}/seed"],
                             env, f"{folder}/munged.out"))
        for _ in range(100):
            if os.path.exists(f"{munge}/socket"):
                break
            time.sleep(0.1)
        for name in ("slurmctld", "slurmd"):
            daemons.append(start([name, "-D", "-f", f"{folder}/slurm.conf"], env,
                                 f"{folder}/{name}.out"))
        wait_until_idle(env, folder)
        yield env
    finally:
        for daemon in reversed(daemons):
            daemon.terminate()
        for daemon in daemons:
            try:
                daemon.wait(20)
            except subprocess.TimeoutExpired:
                daemon.kill()
