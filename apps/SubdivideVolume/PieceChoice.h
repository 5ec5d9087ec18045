// SPDX-License-Identifier: Apache-2.0
#ifndef PieceChoice_h
#define PieceChoice_h

#include <string>

/** What --piece says: one of several pieces of an output, each made by a process of its own. */
struct PieceChoice
{
  bool         IsStatus = false; // list what is missing, and make nothing
  unsigned int Number = 0;       // counted from 1; 0: all of the output by this process
  unsigned int Pieces = 1;
};

/** Reads K/N, "rank" or "status". A rank comes from the environment of Open MPI, of PMI (MPICH, Intel MPI), of a Slurm
 * job array or of srun: the first of these that has more than one.
 * \throw std::invalid_argument */
PieceChoice
ParsePieceChoice(const std::string & text);

#endif
