// SPDX-License-Identifier: Apache-2.0
#include "tiff/TiffStack.h"

#include <limits>
#include <pugixml.hpp>
#include <stdexcept>

namespace
{
constexpr std::uint64_t Nowhere = std::numeric_limits<std::uint64_t>::max();

// Elements may have a name space's prefix.
bool
IsNamed(const pugi::xml_node & node, const std::string & name)
{
  const std::string full = node.name();
  return full.substr(full.find(':') == std::string::npos ? 0 : full.find(':') + 1) == name;
}

std::vector<pugi::xml_node>
GetChildren(const pugi::xml_node & parent, const std::string & name)
{
  std::vector<pugi::xml_node> children;
  for (const pugi::xml_node & child : parent.children())
  {
    if (IsNamed(child, name))
    {
      children.push_back(child);
    }
  }
  return children;
}

std::uint64_t
GetSize(const pugi::xml_node & pixels, const char * name)
{
  const std::uint64_t size = pixels.attribute(name).as_ullong(0);
  if (size == 0 || size > 10000000)
  {
    throw std::runtime_error(std::string("its OME description is damaged: ") + name + " is '" +
                             pixels.attribute(name).value() + '\'');
  }
  return size;
}

std::optional<double>
GetSpacing(const pugi::xml_node & pixels, const std::string & axis)
{
  const double spacing = pixels.attribute(("PhysicalSize" + axis).c_str()).as_double(0.0);
  const auto   unit = GetMillimetres(pixels.attribute(("PhysicalSize" + axis + "Unit").c_str()).as_string("\xC2\xB5m"));
  return spacing > 0.0 && unit ? std::optional<double>(spacing * *unit) : std::nullopt;
}

/** The order of planes in the file: how far apart the neighbours along slices, channels and frames are. */
class PlaneOrder
{
public:
  PlaneOrder(const TiffStack & stack, const std::string & order)
    : m_Stack(stack)
  {
    if (order.size() != 5 || order.compare(0, 2, "XY") != 0 || order.find('Z') == std::string::npos ||
        order.find('C') == std::string::npos || order.find('T') == std::string::npos)
    {
      throw std::runtime_error("its OME description is damaged: DimensionOrder is '" + order + '\'');
    }
    std::uint64_t step = 1;
    for (const char axis : order.substr(2))
    {
      auto & own = axis == 'Z' ? m_SliceStep : axis == 'C' ? m_ChannelStep : m_FrameStep;
      own = step;
      step *= axis == 'Z' ? stack.Slices : axis == 'C' ? stack.Channels : stack.Frames;
    }
  }

  std::uint64_t
  GetPlace(std::uint64_t slice, std::uint64_t channel, std::uint64_t frame) const
  {
    if (slice >= m_Stack.Slices || channel >= m_Stack.Channels || frame >= m_Stack.Frames)
    {
      throw std::runtime_error("its OME description is damaged: it begins with a plane that is not in the stack");
    }
    return slice * m_SliceStep + channel * m_ChannelStep + frame * m_FrameStep;
  }

  /** The index in TiffStack::Planes of what comes at a place. */
  std::uint64_t
  GetIndex(std::uint64_t place) const
  {
    const std::uint64_t slice = place / m_SliceStep % m_Stack.Slices;
    const std::uint64_t channel = place / m_ChannelStep % m_Stack.Channels;
    const std::uint64_t frame = place / m_FrameStep % m_Stack.Frames;
    return (frame * m_Stack.Slices + slice) * m_Stack.Channels + channel;
  }

private:
  const TiffStack & m_Stack;
  std::uint64_t     m_SliceStep = 1;
  std::uint64_t     m_ChannelStep = 1;
  std::uint64_t     m_FrameStep = 1;
};

/** Puts down which pages hold which planes. */
void
PlacePlanes(TiffStack & stack, const pugi::xml_node & data, const PlaneOrder & order, std::uint64_t pages)
{
  const auto          planes = stack.Planes.size();
  const std::uint64_t first = order.GetPlace(data.attribute("FirstZ").as_ullong(0),
                                             data.attribute("FirstC").as_ullong(0),
                                             data.attribute("FirstT").as_ullong(0));
  const std::uint64_t page = data.attribute("IFD").as_ullong(0);
  const std::uint64_t count = data.attribute("PlaneCount").as_ullong(data.attribute("IFD") ? 1 : planes);
  for (std::uint64_t i = 0; i < count; ++i)
  {
    if (first + i >= planes || page + i >= pages)
    {
      throw std::runtime_error("its OME description counts " + std::to_string(planes) + " planes, but it has " +
                               std::to_string(pages) + " pages: it is truncated or has lost pages");
    }
    stack.Planes[order.GetIndex(first + i)] = page + i;
  }
}

void
CheckFiles(const std::vector<pugi::xml_node> & data)
{
  std::string file;
  for (const pugi::xml_node & part : data)
  {
    for (const pugi::xml_node & uuid : GetChildren(part, "UUID"))
    {
      const std::string name = uuid.attribute("FileName").value();
      if (!file.empty() && name != file)
      {
        throw std::runtime_error("it is a part of an OME-TIFF of several files (" + file + ", " + name +
                                 "); save it as one file");
      }
      file = name;
    }
  }
}

std::vector<pugi::xml_node>
GetImages(const pugi::xml_document & document)
{
  std::vector<pugi::xml_node> images;
  for (const pugi::xml_node & root : GetChildren(document, "OME"))
  {
    images = GetChildren(root, "Image");
  }
  return images;
}
} // namespace

std::optional<TiffStack>
ParseOme(const std::string & text, std::uint64_t pages)
{
  pugi::xml_document document;
  if (text.find("OME") == std::string::npos || text.find('<') != text.find_first_not_of(" \r\n\t\xEF\xBB\xBF") ||
      !document.load_buffer(text.data(), text.size()))
  {
    return std::nullopt;
  }
  const auto images = GetImages(document);
  if (images.empty())
  {
    return std::nullopt;
  }
  const auto all = GetChildren(images.front(), "Pixels");
  if (images.size() > 1 || all.size() != 1)
  {
    throw std::runtime_error("its OME description has " + std::to_string(images.size()) +
                             " images; save the one that is meant as a file of its own");
  }
  const pugi::xml_node & pixels = all.front();
  TiffStack              stack;
  stack.Slices = GetSize(pixels, "SizeZ");
  stack.Frames = GetSize(pixels, "SizeT");
  stack.Channels = GetSize(pixels, "SizeC");
  // Colours are one channel.
  const auto channels = GetChildren(pixels, "Channel");
  const auto samples = channels.empty() ? 1 : channels.front().attribute("SamplesPerPixel").as_ullong(1);
  if (samples > 1 && stack.Channels % samples == 0)
  {
    stack.Channels /= samples;
  }
  stack.Spacing = { GetSpacing(pixels, "X"), GetSpacing(pixels, "Y"), GetSpacing(pixels, "Z") };
  stack.IsInMillimetres = true;

  const auto          data = GetChildren(pixels, "TiffData");
  const std::uint64_t planes = CountPlanes(stack);
  CheckFiles(data);
  const PlaneOrder order(stack, pixels.attribute("DimensionOrder").value());
  stack.Planes.assign(planes, Nowhere);
  for (const pugi::xml_node & part : data)
  {
    PlacePlanes(stack, part, order, pages);
  }
  for (const std::uint64_t plane : stack.Planes)
  {
    if (plane == Nowhere)
    {
      throw std::runtime_error("its OME description leaves open where some of its " +
                               std::to_string(stack.Planes.size()) + " planes are");
    }
  }
  return stack;
}
