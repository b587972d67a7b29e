// SPDX-License-Identifier: Apache-2.0
/// toText(), toGraphviz(): the decisions of compile() and their reasons as text.
///   Out     toText: one line per pass (runs or culled, merged or not, and why), per attachment (load and store) and
///           per texture (size, lifetime, which others share its memory). toGraphviz: for `dot -Tsvg`; passes are
///           boxes, textures ellipses; merged passes share a frame, culled ones are dashed.
///           ones are dashed.
///   Thread  one, while graph and plan live.  Memory: the returned string.
#pragma once

#include "framegraph/CompiledGraph.h"

#include <string>

namespace filament::framegraph {

std::string toText(CompiledGraph const& plan);
std::string toGraphviz(CompiledGraph const& plan);

} // namespace filament::framegraph
