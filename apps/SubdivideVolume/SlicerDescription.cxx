// SPDX-License-Identifier: Apache-2.0
#include "SlicerDescription.h"

// 3D Slicer passes an enumeration or a number always, a boolean only where it is true, a string only where it is not
// empty, and the indexed parameters last. So the hidden boolean, true by default, is how the program learns that Slicer
// runs it (vtkSlicerCLIModuleLogic::ApplyTask in https://github.com/Slicer/Slicer/blob/main/Base/QTCLI).
std::string
GetSlicerDescription()
{
  return R"(<?xml version="1.0" encoding="utf-8"?>
<executable>
  <category>Filtering</category>
  <title>Subdivide Volume</title>
  <description><![CDATA[Doubles the resolution of a volume with the non-oscillatory subdivision scheme:
sixth-order accurate where the data is smooth, free of overshoots at isolated edges.]]></description>
  <version>)" +
         GetProgramVersion() + R"(</version>
  <documentation-url></documentation-url>
  <license>Apache-2.0</license>
  <contributor></contributor>
  <acknowledgements><![CDATA[M. Stock, S. Lopez-Urena, "Towards smoother surfaces by applying
subdivision to voxel data".]]></acknowledgements>
  <parameters>
    <label>Volumes</label>
    <description><![CDATA[Input and output]]></description>
    <image>
      <name>input</name>
      <label>Input volume</label>
      <description><![CDATA[The volume to subdivide]]></description>
      <channel>input</channel>
      <index>0</index>
    </image>
    <image reference="input">
      <name>output</name>
      <label>Output volume</label>
      <description><![CDATA[The subdivided volume]]></description>
      <channel>output</channel>
      <index>1</index>
    </image>
  </parameters>
  <parameters>
    <label>Subdivision</label>
    <description><![CDATA[What the filter computes]]></description>
    <string-enumeration>
      <name>scheme</name>
      <longflag>--scheme</longflag>
      <label>Scheme</label>
      <description><![CDATA[nonoscillatory: no overshoots at isolated edges; linear: sharper, rings at edges;
bounded: linear, clamped to the local range; bspline: the smoothest; restored: smooth surfaces with their details
and volumes; default: nonoscillatory, for label maps restored]]></description>
      <default>default</default>
      <element>default</element>
      <element>nonoscillatory</element>
      <element>linear</element>
      <element>bounded</element>
      <element>bspline</element>
      <element>restored</element>
    </string-enumeration>
    <string>
      <name>tension</name>
      <longflag>--tension</longflag>
      <label>Tension</label>
      <description><![CDATA[How close the non-oscillatory and the restored scheme keep to the
linear one; greater than 1, for the restored scheme 0 or greater; empty: 2, for label maps 0]]></description>
      <default></default>
    </string>
    <boolean>
      <name>labels</name>
      <longflag>--labels</longflag>
      <label>Label map</label>
      <description><![CDATA[The voxels are labels: none appears between two others. Schemes: default,
restored, bspline and linear]]></description>
      <default>false</default>
    </boolean>
    <integer>
      <name>levels</name>
      <longflag>--levels</longflag>
      <label>Levels</label>
      <description><![CDATA[How many times to double the resolution]]></description>
      <default>1</default>
      <constraints>
        <minimum>1</minimum>
        <maximum>3</maximum>
        <step>1</step>
      </constraints>
    </integer>
    <string>
      <name>boundary</name>
      <longflag>--boundary</longflag>
      <label>Beyond the image</label>
      <description><![CDATA[nearest, mirror, periodic or a value]]></description>
      <default>nearest</default>
    </string>
    <string>
      <name>axes</name>
      <longflag>--axes</longflag>
      <label>Axes</label>
      <description><![CDATA[The axes to subdivide, such as xyz or xy]]></description>
      <default>xyz</default>
    </string>
    <string-enumeration>
      <name>outputType</name>
      <longflag>--output-type</longflag>
      <label>Output type</label>
      <description><![CDATA[The pixel component type of the output]]></description>
      <default>same</default>
      <element>same</element>
      <element>uint8</element>
      <element>int8</element>
      <element>uint16</element>
      <element>int16</element>
      <element>uint32</element>
      <element>int32</element>
      <element>uint64</element>
      <element>int64</element>
      <element>float</element>
      <element>double</element>
    </string-enumeration>
    <boolean hidden="true">
      <name>progressXml</name>
      <longflag>--progress-xml</longflag>
      <label>Report progress</label>
      <description><![CDATA[Report progress on stdout]]></description>
      <default>true</default>
    </boolean>
  </parameters>
</executable>
)";
}

std::string
GetProgramVersion()
{
  return SUBDIVIDE_VOLUME_VERSION;
}
