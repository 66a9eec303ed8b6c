! Lowest vibrational modes of a packing, how far they spread, its elastic moduli, and the Hessian behind them.
program modes
  use jam_packing
  implicit none
  integer, parameter :: n = 200
  type(packing) :: disks
  type(jam_crunch_report) :: report
  type(jam_modes_options) :: choose
  type(jam_moduli_report) :: moduli
  real(c_double), allocatable :: table(:, :), vector(:, :, :), lambda(:), value(:), u(:)
  integer(c_int32_t), allocatable :: sphere(:), row(:), column(:)
  real(c_double) :: energy
  integer :: k, m

  call disks%random(dim=2, diameters=[(1.0_c_double + merge(0.4_c_double, 0.0_c_double, k > n/2), k=1, n)])
  report = disks%crunch()

  sphere = disks%hessian_map()  ! stable spheres: rattlers have no modes
  call jam_defaults(choose)
  choose%count = 8
  call disks%modes(o=choose, table=table, vector=vector)  ! table(columns, modes), vector(d, stable, modes)
  lambda = table(JAM_MODE_LAMBDA + 1, :)
  print '(a, i0, a)', 'modes of ', size(sphere), ' stable spheres: omega, participation, largest displacement'
  do k = 1, size(lambda)
    print '(f10.5, 2f9.4)', sqrt(max(lambda(k), 0.0_c_double)), table(JAM_MODE_PARTICIPATION + 1, k), &
      maxval(norm2(vector(:, :, k), 1))
  end do

  ! u . H . u of the lowest mode, by the compressed rows of the Hessian, which begin at row(k)
  call disks%hessian(row_start=row, column=column, value=value)
  m = size(row) - 1
  u = reshape(vector(:, :, 1), [m])
  energy = 0
  do k = 1, m
    energy = energy + u(k)*dot_product(value(row(k):row(k + 1) - 1), u(column(row(k):row(k + 1) - 1)))
  end do
  print '(2(a, i0), 2(a, es12.5))', 'Hessian ', m, ' by ', m, ': u . H . u ', energy, ', eigenvalue ', lambda(1)

  moduli = disks%moduli()
  print '(2(a, f8.4))', 'bulk modulus ', moduli%bulk, ', shear modulus ', moduli%shear
  if (abs(energy/lambda(1) - 1) > 1e-6_c_double) error stop 'no mode of this Hessian'
end program modes
