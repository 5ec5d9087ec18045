// SPDX-License-Identifier: Apache-2.0
#ifndef DicomCopies_h
#define DicomCopies_h

#include "dicom/DicomSeries.h"

/** Leaves out files that are copies of others: of one instance UID, and of the same bytes or the same image at the same
 * place.
 * \throw std::runtime_error if files of one instance UID hold different images */
void
LeaveOutCopies(DicomSeries & series, const WarningSink & warn);

#endif
