// SPDX-License-Identifier: Apache-2.0
#ifndef FileLength_h
#define FileLength_h

#include <cstdint>
#include <string>

// Whether files hold as many bytes as their headers say, and whether the headers are of a kind that ITK reads right:
// its readers would go on without a word. Each throws a std::runtime_error if it is not so.

/** A NIfTI or Analyze image, which has as many bytes as its header says, compressed or not. */
void
CheckNiftiLength(const std::string & path);

/** \param bytes of the voxels */
void
CheckGiplLength(const std::string & path, std::uint64_t bytes);

/** ITK's reader of MRC files crashes where the byte order is big-endian. */
void
CheckMrcByteOrder(const std::string & path);

/** The header tells which axis of space is the fastest one and which the slowest, and how many bytes precede the
 * voxels.
 * \param bytes of the voxels */
void
CheckMrcLength(const std::string & path, std::uint64_t bytes);

/** The header tells how many bytes the file has at least. */
void
CheckBmpLength(const std::string & path);

#endif
