! Makes a packing of 200 disks, crunches it and reads its forces. Arrays are x(d, n); sphere indices in results are 0-based.
! gfortran -I<prefix>/lib/.../fortran/jam first.f90 -ljam_fortran -ljam
program first
  use jam
  implicit none
  integer, parameter :: d = 2, n = 200
  type(c_ptr) :: sys, view
  type(jam_create_options) :: create
  type(jam_compress_options) :: compress
  type(jam_md_report) :: md
  type(jam_report) :: report
  real(c_double) :: sizes(n)
  real(c_double), pointer :: x(:, :)
  real(c_double), allocatable :: force(:), modes(:)
  integer(c_int32_t), allocatable :: pairs(:, :)
  type(jam_modes_options) :: choose
  integer(c_size_t) :: length, needed
  integer :: strongest

  sizes(1:n/2) = 1
  sizes(n/2 + 1:n) = 1.4_c_double
  call jam_defaults(create)
  create%dim = d
  create%n = n
  call check(jam_create(create, positions_len=0_c_size_t, diameters=sizes, diameters_len=size(sizes, kind=c_size_t), out=sys))

  call jam_defaults(compress)
  compress%growth_rate = 1e-2_c_double
  compress%pressure = 1e3_c_double
  call check(jam_compress(sys, compress, md))
  print '(a, i0, a, f8.5)', 'collisions ', md%collisions, ', phi ', md%packing_fraction

  call check(jam_crunch(sys, report=report))  ! options left out: the defaults
  print '(a, f10.7, 3(a, i0))', 'phi_J ', report%packing_fraction, ', contacts ', report%contacts, ', rattlers ', &
    report%rattlers, ', excess ', report%excess_contacts

  call check(jam_forces(sys, out_len=0_c_size_t, needed=needed))  ! no array: only the size
  allocate (force(needed), pairs(2, needed))
  call check(jam_forces(sys, force, size(force, kind=c_size_t)))
  call check(jam_contacts(sys, pairs, size(pairs, kind=c_size_t)))
  strongest = maxloc(force, 1)
  call check(jam_positions_view(sys, view, length))
  call c_f_pointer(view, x, [d, n])
  print '(a, f8.4, a, 2(2f8.4, 2x))', 'strongest force ', force(strongest), ' between spheres at ', &
    x(:, pairs(1, strongest) + 1), x(:, pairs(2, strongest) + 1)

  call jam_defaults(choose)
  allocate (modes(choose%count))
  call check(jam_modes(sys, o=choose, lambda=modes, lambda_len=size(modes, kind=c_size_t), vector_len=0_c_size_t, &
                       participation_len=0_c_size_t))
  print '(a, 10f8.4)', 'lowest frequencies ', sqrt(max(modes, 0.0_c_double))

  call check(jam_write(sys, 'fortran_packing.xyz'//c_null_char, JAM_FORMAT_AUTO))
  call jam_destroy(sys)

contains

  subroutine check(status)
    integer(c_int32_t), intent(in) :: status
    if (status > 0) print '(2a)', 'stopped early: ', jam_text(jam_status_string(status))
    if (status >= 0) return
    print '(2a)', 'failed: ', jam_message()
    error stop 1
  end subroutine check
end program first
