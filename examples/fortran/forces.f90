! Reads the contact network of a packing and checks that the forces balance on every sphere.
program forces
  use jam
  implicit none
  integer, parameter :: d = 3, n = 128
  type(c_ptr) :: sys
  type(jam_create_options) :: create
  real(c_double), allocatable :: force(:), normal(:, :)
  integer(c_int32_t), allocatable :: pair(:, :)
  real(c_double) :: net(d, n)
  integer(c_size_t) :: contacts
  integer :: k, i, j

  call jam_defaults(create)
  create%dim = d
  create%n = n
  call jam_check(jam_create(create, out=sys))
  call jam_check(jam_compress(sys))
  call jam_check(jam_crunch(sys))

  call jam_check(jam_forces(sys, out_len=0_c_size_t, needed=contacts))  ! no array: only the size
  allocate (force(contacts), normal(d, contacts), pair(2, contacts))
  call jam_check(jam_forces(sys, force))  ! mean 1
  call jam_check(jam_contact_vectors(sys, normal))  ! unit vectors, from the second to the first
  call jam_check(jam_contacts(sys, pair))

  net = 0
  do k = 1, int(contacts)
    i = pair(1, k) + 1  ! indices of the library begin at 0
    j = pair(2, k) + 1
    net(:, i) = net(:, i) + force(k)*normal(:, k)
    net(:, j) = net(:, j) - force(k)*normal(:, k)
  end do
  k = maxloc(force, 1)
  print '(i0, a, f7.3, 2(a, i0), a, es8.1)', contacts, ' forces, the strongest ', force(k), ' between ', &
    pair(1, k), ' and ', &
    pair(2, k), ', worst imbalance ', maxval(abs(net))
  call jam_destroy(sys)
  if (maxval(abs(net)) > 1e-8_c_double) error stop 'no balance'
end program forces
