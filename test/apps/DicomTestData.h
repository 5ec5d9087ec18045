// SPDX-License-Identifier: Apache-2.0
#ifndef DicomTestData_h
#define DicomTestData_h

#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <utility>
#include <vector>

/** A DICOM data set, encoded here byte by byte. */
class DicomTestData
{
public:
  enum class Syntax
  {
    ImplicitLittle,
    ExplicitLittle,
    ExplicitBig
  };

  /** A slice of 16-bit numbers, of a series, at a height along z. */
  DicomTestData(const std::string &               series,
                int                               number,
                double                            z,
                unsigned int                      columns,
                unsigned int                      rows,
                const std::vector<std::int16_t> & values)
  {
    Set(0x00080016, "UI", "1.2.840.10008.5.1.4.1.1.2");
    Set(0x00080018, "UI", series + "." + std::to_string(number));
    Set(0x00080060, "CS", "CT");
    Set(0x0008103e, "LO", "Thorax " + series);
    Set(0x00100010, "PN", "Doe^Jane");
    Set(0x0020000d, "UI", "1.2.3");
    Set(0x0020000e, "UI", series);
    Set(0x00200013, "IS", std::to_string(number));
    SetPosition(0, 0, z);
    Set(0x00200037, "DS", "1\\0\\0\\0\\1\\0");
    SetShort(0x00280002, 1);
    Set(0x00280004, "CS", "MONOCHROME2");
    SetShort(0x00280010, rows);
    SetShort(0x00280011, columns);
    Set(0x00280030, "DS", "0.75\\0.5");
    SetBits(16, 16, true);
    SetPixels(values);
  }

  DicomTestData() = default;

  /** A file without an image: a report, or another kind. */
  static DicomTestData
  MakeReport(const std::string & kind = "1.2.840.10008.5.1.4.1.1.88.11")
  {
    DicomTestData report;
    report.Set(0x00080016, "UI", kind);
    report.Set(0x00080018, "UI", "1.2.9");
    report.Set(0x0020000e, "UI", "1.2.3.6");
    return report;
  }

  void
  Set(std::uint32_t tag, const std::string & kind, const std::string & value)
  {
    m_Elements[tag] = { kind, value, 1 };
  }

  void
  SetShort(std::uint32_t tag, unsigned int value)
  {
    SetBinary<std::uint16_t>(tag, "US", { static_cast<std::uint16_t>(value) });
  }

  void
  SetPosition(double x, double y, double z)
  {
    Set(0x00200032, "DS", std::to_string(x) + "\\" + std::to_string(y) + "\\" + std::to_string(z));
  }

  void
  SetBits(unsigned int allocated, unsigned int stored, bool isSigned)
  {
    SetShort(0x00280100, allocated);
    SetShort(0x00280101, stored);
    SetShort(0x00280102, stored - 1);
    SetShort(0x00280103, isSigned);
  }

  void
  SetRescale(const std::string & slope, const std::string & intercept)
  {
    Set(0x00281052, "DS", intercept);
    Set(0x00281053, "DS", slope);
  }

  template <typename T>
  void
  SetPixels(const std::vector<T> & values)
  {
    SetBinary(0x7fe00010, "OW", values);
  }

  void
  SetItems(std::uint32_t tag, const std::vector<DicomTestData> & items)
  {
    std::string bytes;
    for (const DicomTestData & item : items)
    {
      const std::string content = item.Encode(Syntax::ExplicitLittle);
      bytes += Number<std::uint32_t>(0xe000fffe, false) + Number<std::uint32_t>(content.size(), false) + content;
    }
    m_Elements[tag] = { "SQ", bytes, 1 };
  }

  void
  Remove(std::uint32_t tag)
  {
    m_Elements.erase(tag);
  }

  void
  Write(const std::filesystem::path & path, Syntax syntax = Syntax::ExplicitLittle) const
  {
    const std::array<const char *, 3> names = { "1.2.840.10008.1.2", "1.2.840.10008.1.2.1", "1.2.840.10008.1.2.2" };
    DicomTestData                     meta;
    meta.Set(0x00020002, "UI", m_Elements.at(0x00080016).Value);
    meta.Set(0x00020003, "UI", "1.2.3.4");
    meta.Set(0x00020010, "UI", names[static_cast<std::size_t>(syntax)]);
    const std::string encoded = meta.Encode(Syntax::ExplicitLittle);
    DicomTestData     length;
    length.SetBinary<std::uint32_t>(0x00020000, "UL", { static_cast<std::uint32_t>(encoded.size()) });
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary)
      << std::string(128, '\0') << "DICM" << length.Encode(Syntax::ExplicitLittle) << encoded << Encode(syntax);
  }

private:
  struct Element
  {
    std::string Kind;
    std::string Value; // little-endian
    std::size_t Width; // bytes of each number
  };

  template <typename T>
  static std::string
  Number(std::uint64_t value, bool isBig)
  {
    std::string bytes;
    for (std::size_t i = 0; i < sizeof(T); ++i)
    {
      bytes += static_cast<char>(value >> 8 * (isBig ? sizeof(T) - 1 - i : i));
    }
    return bytes;
  }

  template <typename T>
  void
  SetBinary(std::uint32_t tag, const std::string & kind, const std::vector<T> & values)
  {
    std::string bytes;
    for (const T value : values)
    {
      bytes += Number<T>(static_cast<std::uint64_t>(value), false);
    }
    m_Elements[tag] = { kind, bytes, sizeof(T) };
  }

  std::string
  Encode(Syntax syntax) const
  {
    const bool  isBig = syntax == Syntax::ExplicitBig;
    std::string bytes;
    for (const auto & [tag, element] : m_Elements)
    {
      std::string value = element.Value;
      for (std::size_t i = 0; isBig && i < value.size(); i += element.Width)
      {
        value.replace(i, element.Width, std::string(value.rend() - i - element.Width, value.rend() - i));
      }
      value += std::string(value.size() % 2, element.Kind == "UI" || element.Kind.front() == 'O' ? '\0' : ' ');
      bytes += Number<std::uint16_t>(tag >> 16, isBig) + Number<std::uint16_t>(tag & 0xffff, isBig);
      const bool isLong = element.Kind.front() == 'O' || element.Kind == "SQ";
      bytes += syntax == Syntax::ImplicitLittle ? "" : element.Kind + (isLong ? std::string(2, '\0') : "");
      bytes += syntax == Syntax::ImplicitLittle || isLong ? Number<std::uint32_t>(value.size(), isBig)
                                                          : Number<std::uint16_t>(value.size(), isBig);
      bytes += value;
    }
    return bytes;
  }

  std::map<std::uint32_t, Element> m_Elements;
};

#endif
