! Lowest vibrational modes of a packing, how far they spread, and its elastic moduli.
program modes
  use jam
  implicit none
  integer, parameter :: d = 2, n = 200, k = 8
  type(c_ptr) :: sys
  type(jam_create_options) :: create
  type(jam_modes_options) :: choose
  type(jam_moduli_report) :: moduli
  real(c_double) :: sizes(n), table(2, k)
  real(c_double), allocatable :: vector(:, :, :)
  integer(c_size_t) :: spheres
  integer :: m

  sizes(1:n/2) = 1
  sizes(n/2 + 1:n) = 1.4_c_double
  call jam_defaults(create)
  create%dim = d
  create%n = n
  call jam_check(jam_create(create, diameters=sizes, out=sys))
  call jam_check(jam_crunch(sys))

  call jam_check(jam_hessian_map(sys, out_len=0_c_size_t, needed=spheres))  ! stable spheres: rattlers have no modes
  call jam_defaults(choose)
  choose%count = k
  allocate (vector(d, spheres, k))
  call jam_check(jam_modes(sys, o=choose, table=table, vector=vector))
  print '(a, i0, a)', 'modes of ', spheres, ' stable spheres: omega, participation, largest displacement'
  do m = 1, k
    print '(f10.5, 2f9.4)', sqrt(max(table(1, m), 0.0_c_double)), table(2, m), maxval(norm2(vector(:, :, m), 1))
  end do
  call jam_check(jam_moduli(sys, moduli=moduli))
  print '(2(a, f8.4))', 'bulk modulus ', moduli%bulk, ', shear modulus ', moduli%shear
  call jam_destroy(sys)
  if (.not. (table(1, 1) > 0 .and. table(1, k) >= table(1, 1))) error stop 'modes are missing'
end program modes
