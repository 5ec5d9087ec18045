// SPDX-License-Identifier: Apache-2.0
#ifndef SlicerDescription_h
#define SlicerDescription_h

#include <string>

/** This program as a command line module of 3D Slicer, in XML, by the schema
 * https://github.com/Slicer/SlicerExecutionModel/blob/main/ModuleDescriptionParser/ModuleDescription.xsd */
std::string
GetSlicerDescription();

std::string
GetProgramVersion();

#endif
