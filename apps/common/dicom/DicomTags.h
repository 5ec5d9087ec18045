// SPDX-License-Identifier: Apache-2.0
#ifndef DicomTags_h
#define DicomTags_h

#include "gdcmDataSet.h"
#include "gdcmTag.h"

#include <optional>
#include <string>
#include <vector>

// Values of a DICOM data set. What is absent or empty is an empty text, no number, no item.

std::string
GetDicomText(const gdcm::DataSet & data, const gdcm::Tag & tag);

/** The numbers of a value of text, such as "0.5\\0.5".
 * \throw std::runtime_error if it is not made of finite numbers */
std::vector<double>
GetDicomNumbers(const gdcm::DataSet & data, const gdcm::Tag & tag);

std::optional<double>
GetDicomNumber(const gdcm::DataSet & data, const gdcm::Tag & tag);

/** A binary number of 16 bits. */
std::optional<unsigned int>
GetDicomShort(const gdcm::DataSet & data, const gdcm::Tag & tag);

/** A binary number of 32 bits. */
std::optional<unsigned int>
GetDicomLong(const gdcm::DataSet & data, const gdcm::Tag & tag);

/** The items of a sequence. */
std::vector<gdcm::DataSet>
GetDicomItems(const gdcm::DataSet & data, const gdcm::Tag & tag);

#endif
