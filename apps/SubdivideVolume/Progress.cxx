// SPDX-License-Identifier: Apache-2.0
#include "Progress.h"
#include "system/process/Terminal.h"

#include <algorithm>
#include <cstdio>
#include <string>

Progress::Progress(Style style)
  : m_Style(style)
{
  if (m_Style == Style::Slicer)
  {
    // The tags that itk::XMLFilterWatcher writes and vtkSlicerCLIModuleLogic::ApplyTask of 3D Slicer looks for; it
    // shows the comment, and sees it at once only if stdout is flushed.
    std::printf("<filter-start>\n<filter-name>SubdivideVolume</filter-name>\n"
                "<filter-comment>Subdividing</filter-comment>\n</filter-start>\n");
    std::fflush(stdout);
  }
}

Progress::~Progress()
{
  if (m_LineIsOpen)
  {
    std::fprintf(GetTerminal(), "\n");
  }
}

void
Progress::Update(double fraction)
{
  const int step = m_Style == Style::Lines ? 10 : 1;
  const int percent = static_cast<int>(100 * std::clamp(fraction, 0.0, 1.0)) / step * step;
  if (m_Style == Style::None || percent <= m_ShownPercent)
  {
    return;
  }
  m_ShownPercent = percent;
  switch (m_Style)
  {
    case Style::Bar:
    {
      constexpr int     width = 40;
      const std::string done(percent * width / 100, '#');
      std::fprintf(GetTerminal(), "\r[%-*s] %3d %%", width, done.c_str(), percent);
      std::fflush(GetTerminal());
      m_LineIsOpen = true;
      break;
    }
    case Style::Lines:
      std::fprintf(GetTerminal(), "%d %%\n", percent);
      break;
    case Style::Slicer:
      std::printf("<filter-progress>%g</filter-progress>\n", percent / 100.0);
      std::fflush(stdout);
      break;
    case Style::None:
      break;
  }
}

void
Progress::Finish()
{
  this->Update(1.0);
  if (m_Style == Style::Slicer)
  {
    std::printf("<filter-end>\n<filter-name>SubdivideVolume</filter-name>\n<filter-time>%g</filter-time>\n"
                "</filter-end>\n",
                this->GetSeconds());
    std::fflush(stdout);
  }
  if (m_LineIsOpen)
  {
    std::fprintf(GetTerminal(), "\n");
    m_LineIsOpen = false;
  }
}

double
Progress::GetSeconds() const
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - m_Start).count();
}
