// SPDX-License-Identifier: Apache-2.0
#include "NonOscillatorySubdivision/Target.h"

#include "kernel/Sweep.h"

#include <stdexcept>

namespace itk
{
namespace Subdivision
{

/** All usable targets, the fastest first. */
struct TargetList
{
  std::vector<Target> Targets;

  TargetList()
  {
#ifdef NonOscillatorySubdivision_HAS_HIGHWAY
    constexpr int       maximum = 16;
    const TargetTable * tables[maximum];
    const int           count = GetVectorisedTargets(tables, maximum);
    for (int i = 0; i < count; ++i)
    {
      Targets.push_back(Target(*tables[i]));
    }
#endif
    Targets.push_back(Target(GetPortableTarget()));
  }

  static const std::vector<Target> &
  Get()
  {
    static const TargetList list;
    return list.Targets;
  }
};

const Target &
Target::Fastest()
{
  return TargetList::Get().front();
}

const Target &
Target::Named(const std::string & name)
{
  if (name.empty())
  {
    return Fastest();
  }
  std::string names;
  for (const Target & target : TargetList::Get())
  {
    if (name == target.GetName())
    {
      return target;
    }
    names += names.empty() ? "" : ", ";
    names += target.GetName();
  }
  throw std::invalid_argument("no target \"" + name + "\" on this processor; there are: " + names);
}

std::vector<std::string>
Target::GetNames()
{
  std::vector<std::string> names;
  for (const Target & target : TargetList::Get())
  {
    names.emplace_back(target.GetName());
  }
  return names;
}

const char *
Target::GetName() const
{
  return m_Table->Name;
}

template <typename TReal>
void
Target::Widen(const ElementType type, const void * elements, const std::size_t count, TReal * values) const
{
  ForType(m_Table->Get<TReal>().Widen, type)(elements, count, values);
}

template NonOscillatorySubdivision_EXPORT void
Target::Widen(ElementType, const void *, std::size_t, float *) const;
template NonOscillatorySubdivision_EXPORT void
Target::Widen(ElementType, const void *, std::size_t, double *) const;

} // namespace Subdivision
} // namespace itk
