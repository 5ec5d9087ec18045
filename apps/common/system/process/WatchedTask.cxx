// SPDX-License-Identifier: Apache-2.0
#include "system/process/WatchedTask.h"
#include "system/process/RunRecord.h"

WatchedTask::WatchedTask(const std::string & failure)
  : m_Outer(GetRunRecord().Task.Get())
{
  GetRunRecord().Task.Set(failure);
}

WatchedTask::~WatchedTask() { GetRunRecord().Task.Set(m_Outer); }

WatchedOpening::WatchedOpening(const std::string & path)
  : m_Task("cannot read " + path)
{
  ++GetRunRecord().OpeningDepth;
}

WatchedOpening::~WatchedOpening() { --GetRunRecord().OpeningDepth; }

void
WatchedOpening::Step(const std::string & path)
{
  GetRunRecord().Task.Set("cannot read " + path);
  ++GetRunRecord().Steps;
}
