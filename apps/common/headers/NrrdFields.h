// SPDX-License-Identifier: Apache-2.0
#ifndef NrrdFields_h
#define NrrdFields_h

#include "system/files/InputFile.h"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

/** The fields of an NRRD's header, by names in small letters without blanks. */
class NrrdFields
{
public:
  /** \throw std::runtime_error if it is no header, or a line of it is none of a header */
  explicit NrrdFields(const InputFile & file);

  std::optional<std::string>
  Find(const std::string & name) const;

  /** \throw std::runtime_error if there is no such field */
  std::string
  Get(const std::string & name) const;

  std::uint64_t                      End = 0;     // where the data follow
  std::vector<std::string>           ListedNames; // after "data file: LIST"
  std::map<std::string, std::string> KeyValues;   // in the form key:=value

private:
  bool
  Parse(const std::string & text, bool isWholeFile);
  void
  ParseLine(const std::string & line, bool isFirst);
  bool
  IsList() const;
  bool
  ParseNames(const std::string & text, bool isWholeFile);

  std::string                        m_Path;
  std::map<std::string, std::string> m_Values;
};

/** A field's name in small letters without blanks. */
std::string
NormaliseNrrdName(const std::string & name);

/** Whether NRRD has a field of this name. */
bool
IsNrrdField(const std::string & name);

#endif
