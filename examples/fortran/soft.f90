! Soft spheres from random points to an energy minimum, its moduli, down to jamming, checked by a crunch, and 1 % up.
program soft
  use jam_packing
  implicit none
  type(packing) :: spheres
  type(jam_create_options) :: create
  type(jam_relax_report) :: minimum, above
  type(jam_hessian_options) :: of_energy
  type(jam_modes_options) :: lowest
  type(jam_moduli_report) :: moduli
  type(jam_decompress_report) :: down
  real(c_double), allocatable :: minima(:, :), table(:, :)  ! (columns, minima), (columns, modes)
  integer :: k

  call jam_defaults(create)
  create%overlap = JAM_OVERLAP_ALLOW  ! uniform points
  call spheres%random(packing_fraction=0.72_c_double, options=create, &
                      diameters=[(1.0_c_double + 0.4_c_double*mod(k, 2), k=1, 100)])
  minimum = spheres%relax()
  print '(3(a, es12.5))', 'energy ', minimum%energy, ', pressure ', minimum%pressure, &
    ', residual ', minimum%force_residual
  if (minimum%converged /= 1) error stop 'no minimum'

  call jam_defaults(of_energy)
  of_energy%stiffness = JAM_STIFFNESS_SOFT
  of_energy%prestress = 1
  moduli = spheres%moduli(of_energy)  ! of the energy that was minimised
  print '(2(a, f8.4))', 'bulk modulus ', moduli%bulk, ', shear modulus ', moduli%shear

  down = spheres%decompress()
  print '(2(a, f12.9), a)', 'phi_J ', down%jammed_fraction, ' from above, ', down%crunch_fraction, ' by crunch'
  minima = spheres%decompress_history()
  do k = 1, size(minima, 2)
    print '(a, es9.2, a, es10.3)', '  distance ', minima(JAM_SOFT_DISTANCE + 1, k), &
      '  pressure ', minima(JAM_SOFT_PRESSURE + 1, k)
  end do
  if (down%same_network /= 1) error stop 'two networks'

  call spheres%scale_diameters(1.01_c_double**(1/3.0_c_double))  ! a packing fraction 1 % above phi_J
  above = spheres%relax()
  call jam_defaults(lowest)
  lowest%count = 1
  call spheres%modes(of_energy, lowest, table)
  print '(3(a, es11.4))', '1 % above phi_J: pressure ', above%pressure, ', lowest frequency ', &
    sqrt(table(JAM_MODE_LAMBDA + 1, 1)), ', largest force ', maxval(spheres%forces())
  if (above%converged /= 1 .or. table(JAM_MODE_LAMBDA + 1, 1) <= 0) error stop 'not stable above phi_J'
end program soft
