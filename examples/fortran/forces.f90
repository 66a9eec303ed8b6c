! Reads the contact network of a packing and checks that the forces balance on every sphere.
program forces
  use jam_packing
  implicit none
  integer, parameter :: d = 3, n = 128
  type(packing) :: spheres
  type(jam_md_report) :: md
  type(jam_crunch_report) :: report
  real(c_double), allocatable :: force(:), normal(:, :), gap(:)
  integer(c_int32_t), allocatable :: pair(:, :), close(:, :)
  real(c_double) :: net(d, n)
  integer :: k

  call spheres%random(n=n, dim=d)
  md = spheres%compress()
  report = spheres%crunch()
  force = spheres%forces()            ! mean 1
  normal = spheres%contact_vectors()  ! (d, contacts): unit vectors, from the second to the first
  pair = spheres%contacts()           ! (2, contacts)

  net = 0
  do k = 1, size(force)
    net(:, pair(1, k)) = net(:, pair(1, k)) + force(k)*normal(:, k)
    net(:, pair(2, k)) = net(:, pair(2, k)) - force(k)*normal(:, k)
  end do
  k = maxloc(force, 1)
  print '(i0, a, f7.3, 2(a, i0), a, es8.1)', size(force), ' forces, the strongest ', force(k), ' between ', &
    pair(1, k), ' and ', pair(2, k), ', worst imbalance ', maxval(abs(net))
  call spheres%gaps(0.1_c_double, .true., gap, close)  ! below 0.1, of stable spheres, ascending
  print '(i0, a, es8.1, 2(a, i0))', size(gap), ' gaps, the smallest ', gap(1), ' between ', &
    close(1, 1), ' and ', close(2, 1)
  if (maxval(abs(net)) > 1e-8_c_double) error stop 'no balance'
end program forces
