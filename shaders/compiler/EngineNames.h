// SPDX-License-Identifier: Apache-2.0
/// EngineNames: keeps the engine's GLSL and the author's apart. Authors may use any name: where theirs is also one of
/// the engine's, the engine's gets the prefix `filament_` in all texts of that material.
///   Why     only then, rather than always: no other material changes by a byte, and the texts stay readable.
///   Thread  any; the tables are made once. Cost: outlines of the engine's texts, 2 ms once.
#pragma once

#include "base/Result.h"
#include "shaders/compiler/GlslOutline.h"

#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace filament_core::shader {

using NameSet = std::set<std::string, std::less<>>;

/// No author may declare names that begin with it.
inline constexpr std::string_view kReservedPrefix = "filament_";

/// Whether errors in this file are about the engine's text rather than an author's.
bool isEngineFile(std::string_view file);

/// What the author's text declares, without what comes from files of the engine that it includes.
std::vector<GlslDeclaration> authorsDeclarations(std::string_view glsl, std::string_view file);

/// Declarations of names that the author cannot have: main, MaterialInputs, what begins with `filament_`.
Result<void> checkNames(std::span<const GlslDeclaration> declarations);

/// The names of the engine that the author declares, too.
void addCollisions(std::span<const GlslDeclaration> declarations, NameSet& out);

/// The engine's text with these names prefixed. Members of structures and blocks keep their names.
std::string withPrefixes(std::string_view engineText, NameSet const& names);

/// Functions and constants for authors (materials guide, 4.5.1) that the prefix has taken away, unless the author's own
/// text declares the same: `float saturate(float a) { return filament_saturate(a); }`.
///   `hasColors`: color.glsl is in the stage.
std::string restoredHelpers(NameSet const& names, std::span<const GlslDeclaration> authors, bool hasColors);

/// The names of those functions and constants, sorted.
std::span<const std::string_view> helperNames();

} // namespace filament_core::shader
