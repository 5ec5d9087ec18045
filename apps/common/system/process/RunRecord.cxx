// SPDX-License-Identifier: Apache-2.0
#include "system/process/RunRecord.h"

#include <algorithm>
#include <cstring>
#include <new>

#include <sys/mman.h>

namespace
{
RunRecord * Record = nullptr;
}

void
SharedText::Set(const std::string & text)
{
  const std::size_t size = std::min(text.size(), sizeof(m_Text) - 1);
  std::memcpy(m_Text, text.data(), size);
  m_Text[size] = '\0';
}

std::string
SharedText::Get() const
{
  return std::string(m_Text, strnlen(m_Text, sizeof(m_Text)));
}

RunRecord &
GetRunRecord()
{
  if (Record == nullptr)
  {
    ResetRunRecord();
  }
  return *Record;
}

void
ResetRunRecord()
{
  void * const memory = mmap(nullptr, sizeof(RunRecord), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED)
  {
    throw std::bad_alloc();
  }
  if (Record != nullptr)
  {
    munmap(Record, sizeof(RunRecord));
  }
  Record = new (memory) RunRecord;
}
