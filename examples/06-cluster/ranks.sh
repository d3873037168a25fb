#!/bin/sh
# A run on the ranks of a SLURM job, which can continue after any interruption:
#   sbatch ranks.sh canopy.toml
# Ninety seconds before the time limit, SLURM signals the batch shell, which puts the job back into the
# queue; the checkpoint holds the completed part.
#SBATCH --ntasks-per-node=1
#SBATCH --nodes=4
#SBATCH --cpus-per-task=32
#SBATCH --time=04:00:00
#SBATCH --signal=B:USR1@90
#SBATCH --requeue
run="$1"
shift
trap 'scontrol requeue "$SLURM_JOB_ID"' USR1
"${MPIRUN:-mpirun}" --bind-to none "${QUASIMC:-quasimc}" run "$run" --threads "${SLURM_CPUS_PER_TASK:-1}" \
    --checkpoint "$run.checkpoint" --resume --progress "$@" &
wait $!
