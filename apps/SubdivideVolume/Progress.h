// SPDX-License-Identifier: Apache-2.0
#ifndef Progress_h
#define Progress_h

#include <chrono>

/** Shows how far the program is. */
class Progress
{
public:
  enum class Style
  {
    None,
    Bar,   ///< one line on stderr that is drawn over and over
    Lines, ///< a line on stderr at every tenth
    Slicer ///< tags on stdout for 3D Slicer
  };

  explicit Progress(Style style);

  /** Ends the line of the bar, so that what follows is not written into it. */
  ~Progress();

  /** \param fraction from 0 to 1, not smaller than before */
  void
  Update(double fraction);

  /** Tells that the work is done. */
  void
  Finish();

  double
  GetSeconds() const;

private:
  const Style                                 m_Style;
  const std::chrono::steady_clock::time_point m_Start = std::chrono::steady_clock::now();
  int                                         m_ShownPercent = -1;
  bool                                        m_LineIsOpen = false;
};

#endif
