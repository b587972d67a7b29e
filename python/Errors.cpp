// SPDX-License-Identifier: Apache-2.0
#include "python/Errors.h"

#include <array>
#include <string>

namespace filament_core::python {
namespace {

enum class Kind : uint8_t { Any, Invalid, NotFound, Unreadable, Corrupt, Unsupported, Device, Memory, Thread, Closed };
constexpr size_t kKinds = static_cast<size_t>(Kind::Closed) + 1;

// Never freed: an exception may be raised until the interpreter is gone.
std::array<PyObject*, kKinds> gClasses{};

Kind kindOf(ErrorCode code) {
    switch (code) {
    case ErrorCode::InvalidArgument:
        return Kind::Invalid;
    case ErrorCode::NotFound:
        return Kind::NotFound;
    case ErrorCode::Unreadable:
        return Kind::Unreadable;
    case ErrorCode::Corrupt:
        return Kind::Corrupt;
    case ErrorCode::Unsupported:
        return Kind::Unsupported;
    case ErrorCode::DeviceUnavailable:
    case ErrorCode::DeviceLost:
        return Kind::Device;
    case ErrorCode::OutOfMemory:
        return Kind::Memory;
    case ErrorCode::Timeout:
    case ErrorCode::Cancelled:
    case ErrorCode::Internal:
        return Kind::Any;
    }
    return Kind::Any;
}

struct ErrorClass {
    Kind kind;
    const char* name;
    PyObject* alsoBase; ///< the exception of Python that it resembles
    const char* code;   ///< of exceptions that Python itself raises
    const char* doc;
};

void addClass(py::module_& module, ErrorClass const& kind) {
    const auto also = py::reinterpret_borrow<py::object>(kind.alsoBase);
    const auto any = py::reinterpret_borrow<py::object>(gClasses[static_cast<size_t>(Kind::Any)]);
    const py::object bases = kind.kind == Kind::Any ? also : py::object(py::make_tuple(any, also));
    const std::string full = std::string("filament_core.") + kind.name;
    PyObject* made = PyErr_NewExceptionWithDoc(full.c_str(), kind.doc, bases.ptr(), nullptr);
    if (!made) throw py::error_already_set();
    gClasses[static_cast<size_t>(kind.kind)] = made;
    py::handle(made).attr("code") = kind.code;
    module.attr(kind.name) = py::handle(made);
}

[[noreturn]] void raiseKind(Kind kind, std::string_view message, std::string_view code) {
    PyErr_Clear(); // what made a check fail
    // Paths in messages need not be UTF-8.
    const auto textOf = [](std::string_view text) {
        PyObject* made = PyUnicode_DecodeUTF8(text.data(), static_cast<Py_ssize_t>(text.size()), "replace");
        if (!made) throw py::error_already_set();
        return py::reinterpret_steal<py::object>(made);
    };
    const py::object error = py::handle(gClasses[static_cast<size_t>(kind)])(textOf(message));
    error.attr("code") = textOf(code);
    PyErr_SetObject(reinterpret_cast<PyObject*>(Py_TYPE(error.ptr())), error.ptr());
    throw py::error_already_set();
}

} // namespace

void bindErrors(py::module_& module) {
    const ErrorClass classes[] = {
        { Kind::Any, "Error", PyExc_Exception, "error",
          "What the engine refuses or cannot do, in one line that names the cure. `code` is the kind of error in "
          "words, such as 'not found'." },
        { Kind::Invalid, "InvalidArgumentError", PyExc_ValueError, "invalid argument",
          "A value outside of its range." },
        { Kind::NotFound, "NotFoundError", PyExc_LookupError, "not found",
          "No such file, device, option or parameter; the message names what is near." },
        { Kind::Unreadable, "UnreadableError", PyExc_OSError, "unreadable", "A file that cannot be read or written." },
        { Kind::Corrupt, "CorruptError", PyExc_ValueError, "corrupt", "A file that violates its own format." },
        { Kind::Unsupported, "UnsupportedError", PyExc_RuntimeError, "unsupported",
          "Well formed, but nothing that this build or device can do." },
        { Kind::Device, "DeviceError", PyExc_RuntimeError, "device", "There is no such device, or it was lost." },
        { Kind::Memory, "OutOfMemoryError", PyExc_MemoryError, "out of memory",
          "Memory of the host or device is exhausted." },
        { Kind::Thread, "ThreadError", PyExc_RuntimeError, "wrong thread",
          "An engine was used on another thread than its own, or closed while another call was at work: see "
          "Engine.use_on_this_thread()." },
        { Kind::Closed, "ClosedError", PyExc_RuntimeError, "closed",
          "Something was used after its engine was closed, or after it was removed from its scene." },
    };
    for (ErrorClass const& each : classes) addClass(module, each);
}

void raise(Error const& error) { raiseKind(kindOf(error.code), error.message, toString(error.code)); }
void raiseThreadError(std::string_view message) { raiseKind(Kind::Thread, message, "wrong thread"); }
void raiseClosedError(std::string_view message) { raiseKind(Kind::Closed, message, "closed"); }

} // namespace filament_core::python
