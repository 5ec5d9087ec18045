// SPDX-License-Identifier: Apache-2.0
#include "system/files/FileDescriptor.h"

#include <cerrno>
#include <utility>

#include <unistd.h>

FileDescriptor::~FileDescriptor()
{
  if (this->IsOpen())
  {
    close(m_Number);
  }
}

FileDescriptor::FileDescriptor(FileDescriptor && other) noexcept
  : m_Number(std::exchange(other.m_Number, None))
{}

FileDescriptor &
FileDescriptor::operator=(FileDescriptor && other) noexcept
{
  std::swap(m_Number, other.m_Number);
  return *this;
}

std::error_code
FileDescriptor::Close()
{
  // A call that was interrupted has closed the file all the same.
  return close(std::exchange(m_Number, None)) == 0 || errno == EINTR ? std::error_code() : GetLastError();
}

std::error_code
GetLastError()
{
  return { errno, std::generic_category() };
}
