// SWIG input of the raw Python layer: jam.raw holds every C function under its C name.
// Arrays go through the buffer protocol, so nothing is copied here and no numpy header is needed. The GIL is released
// around every call (swig -threads). A status below zero raises; above zero it is returned. The typemaps are tied to
// the argument names of the header by jam_gen.i, which is generated.
%module(package="jam") raw
%{
#include <string.h>
#include "jam/jam.h"
#include "pack.h"

static PyObject *jam_error_factory = NULL; /* callable (status, text) -> exception */

/* Texts name files, whose names need not be UTF-8: other bytes show as \xff. */
static PyObject *jam_text(const char *text) { return PyUnicode_DecodeUTF8(text, (Py_ssize_t)strlen(text), "backslashreplace"); }

/* A text for C as new bytes, or NULL with an exception: str as UTF-8, where names of files that are not UTF-8 give their
 * own bytes and other lone surrogates show as \ud800; bytes as they are. A NUL inside would cut it short. */
static PyObject *jam_bytes(PyObject *text) {
  PyObject *bytes = NULL;
  if (PyBytes_Check(text)) {
    bytes = text;
    Py_INCREF(bytes);
  } else if (PyUnicode_Check(text)) {
    bytes = PyUnicode_AsEncodedString(text, "utf-8", "surrogateescape");
    if (!bytes && PyErr_ExceptionMatches(PyExc_UnicodeEncodeError)) {
      PyErr_Clear();
      bytes = PyUnicode_AsEncodedString(text, "utf-8", "backslashreplace");
    }
  } else {
    PyErr_Format(PyExc_TypeError, "a text is needed, not %.100s", Py_TYPE(text)->tp_name);
  }
  if (bytes && strlen(PyBytes_AS_STRING(bytes)) != (size_t)PyBytes_GET_SIZE(bytes)) {
    PyErr_SetString(PyExc_ValueError, "a text must not hold the character NUL");
    Py_CLEAR(bytes);
  }
  return bytes;
}

/* Raises the exception of a status below zero that a call has given. One that a callback has already raised wins. */
static void jam_raise(jam_status status, const char *call) {
  if (PyErr_Occurred()) return;
  const char *text = jam_last_error();
  if (!jam_error_factory) {
    PyErr_SetString(PyExc_RuntimeError, text);
    return;
  }
  PyObject *readable = jam_text(text[0] ? text : jam_status_string(status));
  PyObject *error = readable ? PyObject_CallFunction(jam_error_factory, "iNs", (int)status, readable, call) : NULL;
  if (error) {
    PyErr_SetObject((PyObject *)Py_TYPE(error), error);
    Py_DECREF(error);
  }
}

/* A C-contiguous buffer whose items are of the kind (f, i, u; V for any) and size that C expects. */
static int jam_buffer(PyObject *object, Py_buffer *view, int flags, const char *kind, size_t size, const char *name) {
  memset(view, 0, sizeof *view);
  if (object == Py_None) return 1;
  if (PyObject_GetBuffer(object, view, flags | PyBUF_C_CONTIGUOUS | PyBUF_FORMAT) != 0) return 0;
  const char *format = view->format ? view->format : "B";
  if (*format == (PY_LITTLE_ENDIAN ? '<' : '>') || *format == '=' || *format == '@') ++format;
  const char *wanted = *kind == 'f' ? "d" : *kind == 'i' ? "ilq" : *kind == 'u' ? "ILQ" : *kind == 'c' ? "bBc" : NULL;
  if ((size_t)view->itemsize != size || (wanted && (format[1] || !strchr(wanted, format[0])))) {
    PyErr_Format(PyExc_TypeError, "%s: items of %zd bytes and format '%s' where C needs %zu bytes of kind '%s'", name,
                 view->itemsize, format, size, kind);
    PyBuffer_Release(view);
    return 0;
  }
  return 1;
}

/* Progress trampoline: signals (Ctrl-C) first, then the user's callable. An exception stays set on this thread and is
 * found when the call returns; the non-zero answer makes the library stop with a valid state. */
static int32_t jam_on_progress(const jam_progress *progress, void *user) {
  int32_t stop = 0;
  PyGILState_STATE gil = PyGILState_Ensure();
  if (PyErr_Occurred() || PyErr_CheckSignals() != 0) {
    stop = 1;
  } else if (user) {
    jam_progress *copy = (jam_progress *)malloc(sizeof *copy);
    PyObject *answer = NULL;
    if (copy) {
      *copy = *progress;
      PyObject *proxy = SWIG_NewPointerObj(copy, SWIG_TypeQuery("jam_progress *"), SWIG_POINTER_OWN);
      answer = proxy ? PyObject_CallFunctionObjArgs((PyObject *)user, proxy, NULL) : NULL;
      Py_XDECREF(proxy);
    }
    const int truth = answer ? PyObject_IsTrue(answer) : -1;
    stop = truth != 0;
    Py_XDECREF(answer);
  }
  PyGILState_Release(gil);
  return stop;
}

static void jam_on_log(int32_t level, const char *line, void *user) {
  PyGILState_STATE gil = PyGILState_Ensure();
  if (!PyErr_Occurred()) {
    PyObject *text = jam_text(line);
    PyObject *answer = text ? PyObject_CallFunction((PyObject *)user, "iN", (int)level, text) : NULL;
    Py_XDECREF(answer); /* an exception stays set: the next progress report stops the call */
  }
  PyGILState_Release(gil);
}
%}

%include <stdint.i>
%typemap(out) const char * { $result = jam_text($1); }

// ---- status: an exception below zero, or when a callback raised
%typemap(out) jam_status {
  if ($1 < 0 || PyErr_Occurred()) {
    jam_raise($1, "$symname");
    SWIG_fail;
  }
  $result = PyLong_FromLong($1);
}

// ---- arrays in and out, as (name, name_len); FILL is a writable buffer of the caller, None only asks for the size
%define IN_TYPE(T, KIND)
%typemap(in, numinputs=1) (const T *IN, size_t IN_LEN) (Py_buffer view) {
  if (!jam_buffer($input, &view, PyBUF_SIMPLE, KIND, sizeof(T), "$1_name")) SWIG_fail;
  $1 = (T *)view.buf;
  $2 = (size_t)view.len / sizeof(T);
}
%typemap(arginit) (const T *IN, size_t IN_LEN) { memset(&view$argnum, 0, sizeof view$argnum); }
%typemap(freearg) (const T *IN, size_t IN_LEN) { PyBuffer_Release(&view$argnum); }
%typemap(argout) (const T *IN, size_t IN_LEN) ""  // else a single result of the same name elsewhere would be taken
%enddef
%define FILL_TYPE(T, KIND)
%typemap(in, numinputs=1) (T *FILL, size_t FILL_LEN) (Py_buffer view) {
  if (!jam_buffer($input, &view, PyBUF_WRITABLE, KIND, sizeof(T), "$1_name")) SWIG_fail;
  $1 = (T *)view.buf;
  $2 = (size_t)view.len / sizeof(T);
}
%typemap(arginit) (T *FILL, size_t FILL_LEN) { memset(&view$argnum, 0, sizeof view$argnum); }
%typemap(freearg) (T *FILL, size_t FILL_LEN) { PyBuffer_Release(&view$argnum); }
%typemap(argout) (T *FILL, size_t FILL_LEN) ""
%enddef
IN_TYPE(double, "f")
IN_TYPE(int32_t, "i")
IN_TYPE(int64_t, "i")
IN_TYPE(uint64_t, "u")
FILL_TYPE(double, "f")
FILL_TYPE(int32_t, "i")
FILL_TYPE(int64_t, "i")
FILL_TYPE(uint64_t, "u")
FILL_TYPE(size_t, "u")
FILL_TYPE(char, "c")

// ---- single results
%define RESULT_TYPE(T, MAKE)
%typemap(in, numinputs=0) T *RESULT (T temp) { temp = 0; $1 = &temp; }
%typemap(argout) T *RESULT { %append_output(MAKE(*$1)); }
%enddef
RESULT_TYPE(size_t, PyLong_FromSize_t)
RESULT_TYPE(int32_t, PyLong_FromLong)
RESULT_TYPE(int64_t, PyLong_FromLongLong)
RESULT_TYPE(uint64_t, PyLong_FromUnsignedLongLong)
RESULT_TYPE(double, PyFloat_FromDouble)

// ---- views: (address, number of elements); who keeps the address must keep the system
%typemap(in, numinputs=0) (const double **VIEW, size_t *VIEW_LEN) (const double *data, size_t count) {
  data = NULL; count = 0; $1 = (void *)&data; $2 = &count;
}
%typemap(argout) (const double **VIEW, size_t *VIEW_LEN) {
  %append_output(Py_BuildValue("(NN)", PyLong_FromVoidPtr((void *)*$1), PyLong_FromSize_t(*$2)));
}

// ---- the handle: owned by its Python proxy
%nodefaultctor jam_system;
typedef struct jam_system {} jam_system;
%extend jam_system { ~jam_system() { jam_destroy($self); } }
%ignore jam_destroy;
%typemap(in, numinputs=0) jam_system **out (jam_system *made) { made = NULL; $1 = &made; }
%typemap(argout) jam_system **out {
  %append_output(SWIG_NewPointerObj(*$1, SWIGTYPE_p_jam_system, SWIG_POINTER_OWN));
}

// ---- callbacks. C keeps a pointer to the callable, so the proxy of the handle keeps a reference until C has let it go.
// The interpreter lock is held from the setter's return until the reference has changed (%nothread): neither another
// thread nor Ctrl-C comes between. A callable that the setter itself calls may let other threads in; the handle is busy.
%ignore jam_set_progress;
%ignore jam_set_log;
%nothread jam_notes;  // the text is copied before jam_add_note of another thread may move it
%nothread jam_add_note;
%nothread set_progress;
%nothread set_log;
%{
typedef jam_status (*jam_setter)(jam_system *sys, void *callable, int32_t level);

static jam_status jam_give_progress(jam_system *sys, void *callable, int32_t level) {
  (void)level;
  return jam_set_progress(sys, jam_on_progress, callable);
}
static jam_status jam_give_log(jam_system *sys, void *callable, int32_t level) {
  return callable ? jam_set_log(sys, jam_on_log, level, callable) : jam_set_log(sys, NULL, 0, NULL);
}

/* The references are the items of a list that the handle's proxy has from its first callable on. */
enum { KEPT_PROGRESS, KEPT_LOG };

static jam_status jam_keep(PyObject *handle, PyObject *callable, Py_ssize_t place, jam_setter give, int32_t level) {
  void *sys = NULL;
  jam_status status = JAM_E_NULL;
  PyObject *names = NULL, *fresh = NULL, *key = NULL, *kept = NULL;
  if (!SWIG_IsOK(SWIG_ConvertPtr(handle, &sys, SWIGTYPE_p_jam_system, 0))) {
    PyErr_SetString(PyExc_TypeError, "the handle of a system is needed");
    return status;
  }
  names = PyObject_GenericGetDict(handle, NULL);
  fresh = Py_BuildValue("[OO]", Py_None, Py_None);
  key = PyUnicode_FromString("_kept");
  if (names && fresh && key) kept = PyDict_SetDefault(names, key, fresh); /* of two threads one list stays */
  Py_XINCREF(kept);
  if (kept) status = give((jam_system *)sys, callable == Py_None ? NULL : callable, level);
  if (kept && status >= 0) {
    PyObject *before = PyList_GET_ITEM(kept, place);
    Py_INCREF(callable);
    PyList_SET_ITEM(kept, place, callable);
    Py_DECREF(before);
  }
  Py_XDECREF(kept);
  Py_XDECREF(key);
  Py_XDECREF(fresh);
  Py_XDECREF(names);
  return status;
}
%}
%inline %{
/* callable(progress) on the calling thread, or None: Ctrl-C alone is looked at. */
jam_status set_progress(PyObject *handle, PyObject *callable) {
  return jam_keep(handle, callable, KEPT_PROGRESS, jam_give_progress, 0);
}
/* callable(level, line), or None. */
jam_status set_log(PyObject *handle, PyObject *callable, int32_t level) {
  return jam_keep(handle, callable, KEPT_LOG, jam_give_log, level);
}
void set_error_factory(PyObject *callable) {
  PyObject *before = jam_error_factory;
  Py_INCREF(callable);
  jam_error_factory = callable;
  Py_XDECREF(before);
}
%}

// ---- texts, None for NULL
%typemap(in) const char * (PyObject *bytes) {
  bytes = NULL;
  if ($input != Py_None && !(bytes = jam_bytes($input))) SWIG_fail;
  $1 = bytes ? PyBytes_AS_STRING(bytes) : NULL;
}
%typemap(arginit) const char * { bytes$argnum = NULL; }
%typemap(freearg) const char * { Py_XDECREF(bytes$argnum); }
// ---- names of files: str, bytes or path-like, as the file system encodes them; a NUL inside is refused
%typemap(in) const char *path (PyObject *bytes) {
  bytes = NULL;
  if ($input != Py_None && !PyUnicode_FSConverter($input, &bytes)) SWIG_fail;
  $1 = bytes ? PyBytes_AS_STRING(bytes) : NULL;  // NULL is refused, or means no file
}
%typemap(arginit) const char *path { bytes$argnum = NULL; }
%typemap(freearg) const char *path { Py_XDECREF(bytes$argnum); }

%include "jam_gen.i"
%apply (const double *IN, size_t IN_LEN) {(const double *diameters, size_t diameters_len)};
%rename(jam_create) make_from_arrays;
%rename(jam_read) make_from_file;
%rename(jam_read_checkpoint) make_from_checkpoint;
%feature("docstring") make_from_arrays "jam_create(options, positions (n, d), diameters (n), cell (d, d), callable), each or None";
%inline %{
/* What makes a system, with callable(progress), or None: Ctrl-C alone is looked at. */
jam_status make_from_arrays(const jam_create_options *o, const double *positions, size_t positions_len,
                            const double *diameters, size_t diameters_len, const double *cell, size_t cell_len,
                            PyObject *callable, jam_system **out) {
  jam_start start = {sizeof start, 0, positions, positions_len, diameters, diameters_len, cell, cell_len,
                     jam_on_progress, callable == Py_None ? NULL : (void *)callable};
  return jam_create(o, &start, out);
}
jam_status make_from_file(const char *path, const char *layout, const jam_create_options *o, PyObject *callable,
                          jam_system **out) {
  return jam_read_as(path, layout, o, jam_on_progress, callable == Py_None ? NULL : (void *)callable, out);
}
jam_status make_from_checkpoint(const char *path, PyObject *callable, jam_system **out) {
  return jam_read_checkpoint(path, jam_on_progress, callable == Py_None ? NULL : (void *)callable, out);
}
%}

// ---- the command line: jam-pack's code with what Python adds to it
%typemap(in) (int argc, char **argv) {
  Py_ssize_t k;
  if (!PyList_Check($input)) {
    PyErr_SetString(PyExc_TypeError, "words: a list of bytes");
    SWIG_fail;
  }
  $1 = (int)PyList_Size($input);
  $2 = (char **)calloc((size_t)$1 + 1, sizeof *$2);
  for (k = 0; $2 && k < $1; ++k) {
    $2[k] = PyBytes_AsString(PyList_GetItem($input, k));
    if (!$2[k]) SWIG_fail;
  }
  if (!$2) {
    PyErr_NoMemory();
    SWIG_fail;
  }
}
%typemap(freearg) (int argc, char **argv) { free($2); }
%{
/* The callables of the host; jam_last_error says why they have failed. */
typedef struct jam_callables {
  PyObject *read, *check, *finish, *progress;
} jam_callables;

/* What a callable answers: 0, or -1 also after an exception, which is shown. */
static int jam_answer(PyObject *answer) {
  const int bad = answer == NULL || !PyObject_IsTrue(answer);
  if (!answer) {
    PyErr_Print();
    jam_set_error("an exception in Python");
  }
  Py_XDECREF(answer);
  return bad ? -1 : 0;
}

static PyObject *jam_path(const char *path) {
  if (path) return PyUnicode_DecodeFSDefault(path);
  Py_RETURN_NONE;
}

/* read(path, options) returns the proxy of a handle, or None. */
static int jam_pack_read(const char *path, const jam_create_options *o, void *user, jam_system **sys) {
  PyGILState_STATE gil = PyGILState_Ensure();
  jam_create_options *copy = (jam_create_options *)malloc(sizeof *copy);
  PyObject *proxy = NULL, *answer = NULL;
  void *made = NULL;
  int bad = -1;
  if (copy) {
    *copy = *o;
    proxy = SWIG_NewPointerObj(copy, SWIG_TypeQuery("jam_create_options *"), SWIG_POINTER_OWN);
  }
  if (proxy) answer = PyObject_CallFunction(((jam_callables *)user)->read, "NN", jam_path(path), proxy);
  if (answer && SWIG_IsOK(SWIG_ConvertPtr(answer, &made, SWIG_TypeQuery("jam_system *"), 0)) && made)
    bad = jam_copy((const jam_system *)made, sys) == JAM_OK ? 0 : -1;
  if (!answer) {
    PyErr_Print();
    jam_set_error("an exception in Python");
  }
  Py_XDECREF(answer);
  PyGILState_Release(gil);
  return bad;
}

/* check(output or None, plot or None) returns whether both can be written. */
static int jam_pack_check(const char *output, const char *plot, void *user) {
  PyGILState_STATE gil = PyGILState_Ensure();
  const int bad = jam_answer(PyObject_CallFunction(((jam_callables *)user)->check, "NN", jam_path(output), jam_path(plot)));
  PyGILState_Release(gil);
  return bad;
}

/* finish(handle, output or None, plot or None) returns whether all is written. */
static int jam_pack_finish(jam_system *sys, const char *output, const char *plot, void *user) {
  PyGILState_STATE gil = PyGILState_Ensure();
  PyObject *proxy = SWIG_NewPointerObj(sys, SWIG_TypeQuery("jam_system *"), SWIG_POINTER_OWN);
  const int bad = jam_answer(PyObject_CallFunction(((jam_callables *)user)->finish, "NNN", proxy, jam_path(output),
                                                   jam_path(plot)));
  PyGILState_Release(gil);
  return bad;
}

static int32_t jam_pack_progress(const jam_progress *progress, void *user) {
  return jam_on_progress(progress, ((jam_callables *)user)->progress);
}
%}
// ---- what jam-pack prints and reads has a decimal point, whatever locale the host has set
%{
#include <locale.h>
#ifdef __APPLE__
#include <xlocale.h>
#endif
static locale_t jam_point(void) {
  static locale_t own = (locale_t)0;
  if (!own) own = newlocale(LC_ALL_MASK, "C", (locale_t)0);
  return uselocale(own);
}
%}
%define WITH_POINT(CALL)
%exception CALL {
  const locale_t host = jam_point();
  $action
  uselocale(host);
}
%enddef
WITH_POINT(pack)
WITH_POINT(jam_pack_modes)
WITH_POINT(jam_pack_gaps)
WITH_POINT(jam_pack_structure)
%inline %{
/* Runs a command line, whose first word is the name of the program, and returns the exit status. */
int pack(int argc, char **argv, PyObject *read, PyObject *check, PyObject *finish, PyObject *progress) {
  jam_callables callables = {read, check, finish, progress};
  jam_pack_host host = {argc > 0 ? argv[0] : "jam", jam_pack_read, jam_pack_check, jam_pack_finish, jam_pack_progress,
                        &callables};
  return jam_pack(argc, argv, &host);
}
%}
// ---- tables of the jammed network as jam-pack writes them: [status, text], None where the call was stopped
%typemap(in, numinputs=0) char **text (char *made) { made = NULL; $1 = &made; }
%typemap(argout) char **text {
  %append_output(*$1 ? PyUnicode_FromString(*$1) : SWIG_Py_Void());
  free(*$1);
}
%apply (const double *IN, size_t IN_LEN) {(const double *mode, size_t mode_len)};
%rename(table_of_modes) jam_pack_modes;
%rename(table_of_gaps) jam_pack_gaps;
%rename(table_of_structure) jam_pack_structure;
jam_status jam_pack_modes(const double *mode, size_t mode_len, char **text);
jam_status jam_pack_gaps(const jam_system *sys, double h_max, char **text);
jam_status jam_pack_structure(const jam_system *sys, char **text);
%include "jam/jam.h"
