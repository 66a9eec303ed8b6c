! Brings a packing from a file to its jamming point and writes it again.  usage: crunch_file IN OUT
program crunch_file
  use jam_packing
  implicit none
  type(packing) :: spheres
  type(jam_info) :: now
  type(jam_crunch_options) :: options
  type(jam_crunch_report) :: report
  character(1024) :: name(2)
  integer :: k

  if (command_argument_count() /= 2) error stop 'usage: crunch_file IN OUT'
  do k = 1, 2
    call get_command_argument(k, name(k))
  end do
  call spheres%read_file(name(1))  ! plain text, extended XYZ, LAMMPS; a failure prints its reason and ends the program
  now = spheres%info()
  print '(a, i0, a, i0, a, f9.6)', 'spheres ', now%n, ', d = ', now%dim, ', phi ', now%packing_fraction

  call jam_defaults(options)
  options%wall_time = 600  ! seconds; what was reached by then is kept
  report = spheres%crunch(options)
  if (spheres%status > 0) print '(2a)', 'stopped early: ', spheres%why()
  print '(a, f15.12, 3a, i0, a, i0)', 'phi_J ', report%packing_fraction, ' (', &
    jam_text(jam_stop_string(report%stop_reason)), '), contacts ', report%contacts, ', excess ', report%excess_contacts
  print '(2(a, es8.1))', 'overlap ', report%max_overlap, ', force imbalance ', report%force_residual
  call spheres%write_file(name(2))
  if (report%jammed /= 1) error stop 'not jammed'
end program crunch_file
