! A packing in d = 2 for ParaView (picture.vtp, filter Glyph: sphere, scale by diameter), its forces (picture-
! forces.vtp), and a page for a browser (picture.html).
program picture
  use jam_packing
  implicit none
  integer, parameter :: n = 200
  type(packing) :: disks
  type(jam_crunch_report) :: report
  integer(c_int32_t), allocatable :: contacts(:)
  integer :: k

  call disks%random(dim=2, diameters=[(1.0_c_double + merge(0.4_c_double, 0.0_c_double, k > n/2), k=1, n)])
  report = disks%crunch()
  contacts = disks%coordination()
  call disks%write_file('picture.vtp')
  call disks%write_contacts('picture-forces.vtp', JAM_CONTACTS_AUTO)
  call disks%write_page('picture.html', 'Two hundred disks', .false., 'contacts', real(contacts, c_double))
  print '(i0, 2(a, i0))', n, ' disks, ', count(contacts == 3), ' bucklers, rattlers ', count(contacts == 0)
end program picture
