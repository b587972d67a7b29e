// SPDX-License-Identifier: Apache-2.0
/// toText(), toGraphviz(), describePass(): the decisions of compile() and their reasons as text.
///   Out     toText: one line per pass (runs or culled, merged or not, and why), per attachment (load and store) and
///           per texture (size, lifetime, which others share its memory), and their memory. toGraphviz: for `dot
///           -Tsvg`; passes are boxes, textures ellipses; merged passes share a frame, culled ones are dashed.
///   Thread  one, while graph and plan live.  Memory: the returned string.
#pragma once

#include "framegraph/CompiledGraph.h"

#include <string>

namespace filament_core::framegraph {

/// The reason of one pass, by declaration: "runs: it writes output 'output'; merged with the pass before it".
std::string describePass(CompiledGraph const& plan, size_t pass);
std::string toText(CompiledGraph const& plan);
std::string toGraphviz(CompiledGraph const& plan);

} // namespace filament_core::framegraph
