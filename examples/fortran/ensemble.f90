! Many seeds; mean and standard error of phi_J.  (Images of a coarray program, or MPI ranks, would take a share of the
! seeds each: handles are independent.)
program ensemble
  use jam_packing
  implicit none
  integer, parameter :: seeds = 6, n = 128
  real(c_double) :: phi(seeds), mean, error
  integer :: k, jammed

  jammed = 0
  do k = 1, seeds
    call pack(k)
  end do
  if (jammed < 2) error stop 'too few jammed packings'
  mean = sum(phi(1:jammed))/jammed
  error = sqrt(sum((phi(1:jammed) - mean)**2)/(jammed - 1)/jammed)
  print '(2(i0, a), f8.5, a, f7.5)', jammed, ' of ', seeds, ' jammed, phi_J ', mean, ' +- ', error

contains

  subroutine pack(seed)
    integer, intent(in) :: seed
    type(packing) :: disks  ! freed at the end of this procedure
    type(jam_compress_options) :: growth
    type(jam_md_report) :: md
    type(jam_crunch_report) :: report
    real(c_double) :: sizes(n)
    sizes(1:n/2) = 1
    sizes(n/2 + 1:n) = 1.4_c_double
    call disks%random(dim=2, seed=seed, diameters=sizes)
    call jam_defaults(growth)
    growth%growth_rate = 3e-2_c_double
    growth%pressure = 1e4_c_double
    md = disks%compress(growth)
    report = disks%crunch()
    print '(a, i0, a, f12.9)', 'seed ', seed, ': phi ', report%packing_fraction
    if (report%jammed /= 1) return
    jammed = jammed + 1
    phi(jammed) = report%packing_fraction
  end subroutine pack
end program ensemble
