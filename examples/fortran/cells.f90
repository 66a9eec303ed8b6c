! Cells that are no cubes: a tilted start, a crunch with a free cell that ends strictly jammed, simple shear.
program cells
  use jam_packing
  implicit none
  type(packing) :: disks
  type(jam_compress_options) :: growth
  type(jam_md_report) :: md
  type(jam_crunch_options) :: options
  type(jam_crunch_report) :: report
  type(jam_rigidity_report) :: strict
  real(c_double) :: vectors(2, 2), shear(2, 2)
  real(c_double), allocatable :: cell(:, :)
  integer :: k

  vectors = reshape([1.0_c_double, 0.0_c_double, 0.3_c_double, 1.0_c_double], [2, 2])  ! a vector in each column
  call disks%random(dim=2, cell=vectors, diameters=[(1.0_c_double + 0.4_c_double*mod(k, 2), k=1, 60)])
  call jam_defaults(growth)
  growth%growth_rate = 3e-2_c_double
  growth%pressure = 1e3_c_double
  md = disks%compress(growth)

  call jam_defaults(options)
  options%strain = JAM_STRAIN_FREE  ! the cell deforms at fixed volume after the optimum of the fixed one
  report = disks%crunch(options)
  strict = disks%rigidity(JAM_RIGIDITY_STRICT)
  cell = disks%cell()
  print '(a, f12.9, a, i0)', 'phi_J ', report%packing_fraction, ', strictly jammed ', strict%jammed
  print '(a, 2f10.6)', ('cell vector ', cell(:, k), k=1, 2)
  if (strict%jammed /= JAM_VERDICT_YES) error stop 'not strictly jammed'

  call disks%scale_diameters(0.99_c_double)
  shear = 0
  shear(2, 1) = 2e-3_c_double  ! x moves by y: rows of C's matrices are columns here
  call disks%strain(shear)
  cell = disks%cell()
  print '(a, 2f10.6)', ('sheared to  ', cell(:, k), k=1, 2)
end program cells
