! From nothing to a jammed packing of 200 disks.  Arrays are x(d, n), indices count from 1.
! gfortran first.f90 $(pkg-config --cflags --libs jam-fortran)
program first
  use jam_packing
  implicit none
  integer, parameter :: n = 200
  type(packing) :: disks
  type(jam_compress_options) :: growth
  type(jam_md_report) :: md
  type(jam_crunch_report) :: report
  real(c_double) :: sizes(n)
  real(c_double), allocatable :: x(:, :)

  sizes(1:n/2) = 1  ! two sizes, so that disks do not crystallise; only their ratio counts
  sizes(n/2 + 1:n) = 1.4_c_double
  call disks%random(dim=2, seed=1, diameters=sizes)

  call jam_defaults(growth)
  growth%growth_rate = 1e-2_c_double
  growth%pressure = 1e3_c_double
  md = disks%compress(growth)
  print '(a, i0, a, f8.5)', 'collisions ', md%collisions, ', phi ', md%packing_fraction

  report = disks%crunch()  ! without options: the defaults
  print '(a, f10.7, 3(a, i0))', 'phi_J ', report%packing_fraction, ', contacts ', report%contacts, ', rattlers ', &
    report%rattlers, ', excess ', report%excess_contacts
  if (report%jammed /= 1) error stop 'not jammed'
  x = disks%positions()
  print '(a, 2f8.4)', 'first sphere at ', x(:, 1)
  call disks%write_file('fortran_packing.xyz')
end program first
