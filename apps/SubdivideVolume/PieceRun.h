// SPDX-License-Identifier: Apache-2.0
#ifndef PieceRun_h
#define PieceRun_h

#include "Options.h"
#include "Pieces.h"
#include "pieces/PieceWriter.h"

#include <vector>

/** The boxes of one of several pieces of an output, in their order in the file. Pieces are about the same size. May be
 * empty, where there are more pieces than rows, or than planes if they are not split. */
Piece
SelectPiece(const Box & whole, const PieceChoice & choice, bool splitsPlanes);

/** What a process that makes a piece says at its end. */
std::string
DescribePieces(const Options &                   options,
               unsigned int                      pieces,
               const std::vector<unsigned int> & missing,
               bool                              isComplete);

/** Lists the pieces that are missing.
 * \throw std::runtime_error if no pieces of the output are being made */
void
PrintMissingPieces(const Options & options);

#endif
