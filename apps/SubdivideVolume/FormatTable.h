// SPDX-License-Identifier: Apache-2.0
#ifndef FormatTable_h
#define FormatTable_h

#include <string>

/** The image formats, what the names of their files end in, and what can be done with them: a table for people, or
 * JSON.
 */
std::string
DescribeFormats(bool asJson);

#endif
