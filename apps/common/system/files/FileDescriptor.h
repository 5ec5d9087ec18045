// SPDX-License-Identifier: Apache-2.0
#ifndef FileDescriptor_h
#define FileDescriptor_h

#include <system_error>

/** The number of an open file, which is closed with this object. */
class FileDescriptor
{
public:
  static constexpr int None = -1;

  FileDescriptor() = default;
  /** \param number what the system gave, or None */
  explicit FileDescriptor(int number)
    : m_Number(number)
  {}
  ~FileDescriptor();
  FileDescriptor(FileDescriptor && other) noexcept;
  FileDescriptor &
  operator=(FileDescriptor && other) noexcept;

  bool
  IsOpen() const
  {
    return m_Number != None;
  }

  int
  GetNumber() const
  {
    return m_Number;
  }

  /** File systems of other machines tell here what they could not write before. */
  std::error_code
  Close();

private:
  int m_Number = None;
};

/** What the last call of the system failed of. */
std::error_code
GetLastError();

#endif
