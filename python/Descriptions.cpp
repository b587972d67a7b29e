// SPDX-License-Identifier: Apache-2.0
// What the engine counts and declares, as dictionaries.
#include "python/Bindings.h"

namespace filament_core::python {

py::dict dictOfCounts(std::initializer_list<std::pair<const char*, uint64_t>> counts) {
    py::dict dict;
    for (auto const& [name, count] : counts) dict[name] = count;
    return dict;
}

py::list listOf(std::span<const ParameterDescription> parameters) {
    py::list list;
    for (ParameterDescription const& parameter : parameters) {
        py::dict dict;
        dict["name"] = parameter.name;
        dict["type"] = toString(parameter.type);
        dict["array_size"] = parameter.arraySize;
        list.append(dict);
    }
    return list;
}

} // namespace filament_core::python
