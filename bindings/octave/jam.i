// SWIG's Octave module: packings as objects with a method for each call, which octave/jam_gen.i declares.
%module jam
%{
#include "call.hpp"
%}
%feature("compactdefaultargs");
%typemap(out) octave_value_list { _outp->append($1); }
%{
namespace jam_octave {
static octave_value made(jam_system *sys) { return SWIG_NewPointerObj(sys, SWIGTYPE_p_jam_system, SWIG_POINTER_OWN); }
static jam_system *packing_of(const octave_value &value, const char *name) {
  void *sys = nullptr;
  if (!SWIG_IsOK(SWIG_ConvertPtr(value, &sys, SWIGTYPE_p_jam_system, 0)) || !sys) refuse(std::string(name) + " must be a packing");
  return static_cast<jam_system *>(sys);
}
// positions and velocities (n, d), diameters (n, 1)
static octave_value view(const jam_system *sys, int32_t array) {
  const double *data = nullptr;
  size_t size = 0;
  jam_info info = {};
  info.struct_size = sizeof info;
  const jam_status status = jam_view(sys, array, &data, &size);
  if (status < 0) error_with_id(("jam:" + word_of(status_words, status)).c_str(), "%s", jam_last_error());
  jam_get_info(sys, &info);
  const bool each = size == static_cast<size_t>(info.n);
  NDArray x(dim_vector(static_cast<octave_idx_type>(info.n), each ? 1 : info.dim));
  for (octave_idx_type k = 0; k < x.numel(); ++k) x(turned(k, x.dims(), 2)) = data[k];
  return x;
}
}  // namespace jam_octave
%}
%include "octave/jam_gen.i"
%extend jam_system {
  ~jam_system() { jam_destroy($self); }
  octave_value_list positions() { return octave_value_list(jam_octave::view($self, JAM_VIEW_POSITIONS)); }
  octave_value_list velocities() { return octave_value_list(jam_octave::view($self, JAM_VIEW_VELOCITIES)); }
  octave_value_list diameters() { return octave_value_list(jam_octave::view($self, JAM_VIEW_DIAMETERS)); }
}
%nodefaultctor jam_system;
typedef struct jam_system {} jam_system;  // behind all that its methods call
%rename(random) random_packing;
%inline %{
// random(n, options): create(options) with the number of spheres before them
static octave_value_list random_packing(const octave_value_list &varargs = octave_value_list(), ...) {
  if (varargs.length() == 0 || varargs(0).is_string() || varargs(0).isstruct()) return jam_octave::call_create(nullptr, varargs);
  octave_value_list named("n");
  return jam_octave::call_create(nullptr, named.append(varargs));
}
%}
