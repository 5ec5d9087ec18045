// SPDX-License-Identifier: Apache-2.0
#ifndef PieceAgreement_h
#define PieceAgreement_h

#include "Options.h"
#include "pieces/PieceFolder.h"
#include "volumes/ImageDescription.h"

/** What all processes that make pieces of one output must have in common: the input as it is now, the options that the
 * bytes of the output depend on, and the program. */
PieceAgreement
MakePieceAgreement(const Options & options, const ImageDescription & input, const ImageDescription & output);

#endif
