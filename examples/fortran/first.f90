! From nothing to a jammed packing of 200 disks.  Arrays are x(d, n); indices in results are 0-based.
! gfortran first.f90 $(pkg-config --cflags --libs jam-fortran)
program first
  use jam
  implicit none
  integer, parameter :: d = 2, n = 200
  type(c_ptr) :: sys, view
  type(jam_create_options) :: create
  type(jam_compress_options) :: compress
  type(jam_md_report) :: md
  type(jam_crunch_report) :: report
  real(c_double) :: sizes(n)
  real(c_double), pointer :: x(:, :)
  integer(c_size_t) :: length

  sizes(1:n/2) = 1  ! two sizes, so that disks do not crystallise; only their ratio counts
  sizes(n/2 + 1:n) = 1.4_c_double
  call jam_defaults(create)
  create%dim = d
  create%n = n
  call jam_check(jam_create(create, diameters=sizes, out=sys))

  call jam_defaults(compress)
  compress%growth_rate = 1e-2_c_double
  compress%pressure = 1e3_c_double
  call jam_check(jam_compress(sys, compress, md))
  print '(a, i0, a, f8.5)', 'collisions ', md%collisions, ', phi ', md%packing_fraction

  call jam_check(jam_crunch(sys, report=report))  ! without options: the defaults
  print '(a, f10.7, 3(a, i0))', 'phi_J ', report%packing_fraction, ', contacts ', report%contacts, ', rattlers ', &
    report%rattlers, ', excess ', report%excess_contacts
  call jam_check(jam_view_positions(sys, view, length))  ! the library's own memory, good as long as sys
  call c_f_pointer(view, x, [d, n])
  print '(a, 2f8.4)', 'first sphere at ', x(:, 1)

  call jam_check(jam_write(sys, 'fortran_packing.xyz', JAM_FORMAT_AUTO))
  call jam_destroy(sys)
end program first
