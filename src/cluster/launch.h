#pragma once

namespace ifov::cluster {

/// Whether a launcher (mpirun, srun) started this process as one of several, by what it left in the
/// environment: Open MPI's OMPI_COMM_WORLD_SIZE, the PMI_SIZE of MPICH and Slurm, or a PMIx rank in a Slurm
/// step of several tasks. MPI is not asked.
bool is_one_of_several();

}  // namespace ifov::cluster
