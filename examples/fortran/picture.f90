! A packing in d = 2 as a VTK file for ParaView: points with diameter and contacts, shown by the filter Glyph (sphere,
! scale by diameter, factor 1).  The file is picture.vtk.
program picture
  use jam
  implicit none
  integer, parameter :: d = 2, n = 200
  type(c_ptr) :: sys, view
  type(jam_create_options) :: create
  real(c_double) :: sizes(n)
  real(c_double), pointer :: x(:, :), sigma(:)
  integer(c_int32_t) :: contacts(n)
  integer(c_size_t) :: length
  integer :: file, i

  sizes(1:n/2) = 1
  sizes(n/2 + 1:n) = 1.4_c_double
  call jam_defaults(create)
  create%dim = d
  create%n = n
  call jam_check(jam_create(create, diameters=sizes, out=sys))
  call jam_check(jam_crunch(sys))
  call jam_check(jam_view_positions(sys, view, length))  ! no copies
  call c_f_pointer(view, x, [d, n])
  call jam_check(jam_view_diameters(sys, view, length))
  call c_f_pointer(view, sigma, [n])
  call jam_check(jam_coordination(sys, contacts))

  open (newunit=file, file='picture.vtk', status='replace')
  write (file, '(a)') '# vtk DataFile Version 3.0', 'packing of disks', 'ASCII', 'DATASET POLYDATA'
  write (file, '(a, i0, a)') 'POINTS ', n, ' double'
  write (file, '(3es25.16e3)') (x(:, i), 0.0_c_double, i=1, n)
  write (file, '(a, i0, 1x, i0)') 'VERTICES ', n, 2*n
  write (file, '(i0, 1x, i0)') (1, i - 1, i=1, n)
  write (file, '(a, i0)') 'POINT_DATA ', n
  write (file, '(a)') 'SCALARS diameter double 1', 'LOOKUP_TABLE default'
  write (file, '(es25.16e3)') sigma
  write (file, '(a)') 'SCALARS contacts int 1', 'LOOKUP_TABLE default'
  write (file, '(i0)') contacts
  close (file)
  print '(i0, 2(a, i0))', n, ' disks, ', count(contacts == d + 1), ' bucklers, rattlers ', count(contacts == 0)
  call jam_destroy(sys)
end program picture
