// SPDX-License-Identifier: Apache-2.0
#ifndef MetaFields_h
#define MetaFields_h

#include "system/files/InputFile.h"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

/** The fields of a MetaImage's header. */
class MetaFields
{
public:
  /** \throw std::runtime_error if it is no header */
  explicit MetaFields(const InputFile & file);

  /** The value of the field that goes by one of these names.
   * \throw std::runtime_error if two of them contradict each other */
  std::optional<std::string>
  Find(const std::vector<std::string> & names) const;

  /** \throw std::runtime_error if there is no such field */
  std::string
  Get(const std::string & name) const;

  bool
  GetFlag(const std::vector<std::string> & names, bool otherwise) const;

  const std::map<std::string, std::string> &
  GetAll() const
  {
    return m_Values;
  }

  std::uint64_t End = 0; // where the voxels or the names of data files follow

private:
  /** Returns whether the last field was there. */
  bool
  Parse(const std::string & text);

  std::string                        m_Path;
  std::map<std::string, std::string> m_Values;
};

/** Whether MetaImage's readers take a key for one of their own fields. */
bool
IsMetaField(const std::string & key);

#endif
