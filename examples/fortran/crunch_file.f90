! Brings a packing from a file to its jamming point and writes it again.  usage: crunch_file IN OUT
program crunch_file
  use jam
  implicit none
  type(c_ptr) :: sys
  type(jam_info) :: info
  type(jam_crunch_options) :: options
  type(jam_crunch_report) :: report
  character(1024) :: name(2)
  integer :: k

  if (command_argument_count() /= 2) error stop 'usage: crunch_file IN OUT'
  do k = 1, 2
    call get_command_argument(k, name(k))
  end do
  call jam_check(jam_read(name(1), out=sys))  ! plain text or extended XYZ
  call jam_check(jam_get_info(sys, info))
  print '(a, i0, a, i0, a, f9.6)', 'spheres ', info%n, ', d = ', info%dim, ', phi ', info%packing_fraction

  call jam_defaults(options)
  options%wall_time = 600  ! seconds; what was reached by then is kept
  call jam_check(jam_crunch(sys, options, report))
  print '(2a, f16.12)', jam_text(jam_stop_string(report%stop_reason)), ', phi ', report%packing_fraction
  print '(2(a, i0))', 'contacts ', report%contacts, ', more than isostatic ', report%excess_contacts
  print '(2(a, es8.1))', 'overlap ', report%max_overlap, ', force imbalance ', report%force_residual
  call jam_check(jam_write(sys, name(2), JAM_FORMAT_AUTO))
  call jam_destroy(sys)
  if (report%jammed /= 1) error stop 'not jammed'
end program crunch_file
