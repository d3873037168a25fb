#!/bin/sh
# One part of a run for each job of a SLURM array:
#   sbatch --array=1-16 array.sh canopy.toml
# and then: quasimc merge part.* --json canopy.json
#SBATCH --cpus-per-task=4
"${QUASIMC:-quasimc}" run "$1" --part "$SLURM_ARRAY_TASK_ID/$SLURM_ARRAY_TASK_COUNT" \
    --part-file "part.$SLURM_ARRAY_TASK_ID" --quiet
