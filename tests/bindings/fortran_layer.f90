! The Fortran module: defaults, arrays x(d, n), absent arguments, reports, callbacks, errors.
module counting
  use jam
  implicit none
  integer, save :: calls = 0
contains
  function stop_at_third(progress, user) bind(c) result(stop_now)
    type(jam_progress), intent(in) :: progress
    type(c_ptr), value :: user
    integer(c_int32_t) :: stop_now
    calls = calls + 1
    stop_now = 0
    if (calls >= 3 .and. progress%phase == JAM_PHASE_CRUNCH) stop_now = 1
    if (c_associated(user)) stop_now = -1
  end function stop_at_third
end module counting

program fortran_layer
  use jam
  use counting
  implicit none
  integer, parameter :: d = 2, n = 60
  type(c_ptr) :: sys, other, view
  type(jam_create_options) :: create
  type(jam_start) :: start
  type(jam_crunch_options) :: options
  type(jam_crunch_report) :: report
  type(jam_info) :: info
  real(c_double) :: x(d, n), sizes(n)
  real(c_double), pointer :: seen(:, :)
  real(c_double), allocatable :: force(:), normal(:, :), again(:), wide(:, :)
  integer(c_int32_t), allocatable :: pairs(:, :)
  integer(c_size_t) :: needed, view_len
  integer(c_int32_t) :: status
  integer :: failures

  failures = 0
  call expect(jam_abi_version() == JAM_ABI, 'abi')
  call expect(len(jam_text(jam_version())) >= 5, 'version')
  sizes = 1
  sizes(1::2) = 1.4_c_double
  call jam_defaults(create)
  call expect(create%dim == 3 .and. create%packing_fraction == 0.0_c_double, 'defaults')
  create%dim = d
  create%n = n
  create%seed = 3
  status = jam_create(create, diameters=sizes, out=sys)
  call expect(status == JAM_OK, 'create')
  status = jam_get_info(sys, info)
  call expect(info%n == n .and. info%dim == d, 'info')
  call expect(jam_text(jam_notes(sys)) == '', 'nothing was changed')
  status = jam_view(sys, JAM_VIEW_POSITIONS, view, view_len)
  call expect(view_len == d*n, 'view length')
  call c_f_pointer(view, seen, [d, n])
  x = modulo(seen + 0.25_c_double, 1.0_c_double)
  status = jam_set_positions(sys, x)
  call expect(status == JAM_OK .and. all(seen == x), 'x(d, n) goes in and comes out')

  call draw_sizes()
  status = jam_crunch(sys, report=report)
  call expect(status == JAM_OK .and. report%jammed == 1, 'crunch')
  status = jam_forces(sys, out_len=0_c_size_t, needed=needed)
  call expect(status == JAM_OK .and. needed == report%contacts, 'count')
  allocate (force(needed), normal(d, needed), pairs(2, needed), again(needed), wide(d, 2*needed))
  call expect(jam_forces(sys, force, size(force, kind=c_size_t)) == JAM_OK, 'forces')
  call expect(jam_contact_vectors(sys, normal) == JAM_OK, 'vectors')
  call expect(jam_contacts(sys, pairs) == JAM_OK, 'pairs')
  call expect(abs(sum(force)/size(force) - 1) < 1e-12_c_double, 'their mean')
  call expect(jam_forces(sys, force, 1_c_size_t, needed) == JAM_E_BUFFER, 'short buffer')
  ! the second forms: arrays of any rank whose lengths are known, strided ones too, and plain strings
  again = 0
  call expect(jam_forces(sys, again) == JAM_OK, 'forces by an array')
  call expect(all(again == force), 'the same forces')
  call expect(jam_forces(sys, again(1:1)) == JAM_E_BUFFER, 'a section that is too short')
  wide = 0
  call expect(jam_contact_vectors(sys, wide(:, ::2)) == JAM_OK, 'a strided array')
  call expect(all(wide(:, ::2) == normal) .and. all(wide(:, 2::2) == 0), 'is filled where it is')
  call expect(jam_write(sys, 'no/such/folder.xyz   ', JAM_FORMAT_AUTO) == JAM_E_IO, 'a file that cannot be written')
  call expect(index(jam_message(), 'no/such/folder.xyz:') > 0, 'its name without blanks: '//jam_message())

  call shapes_and_lengths()

  status = jam_copy(sys, other)
  call jam_destroy(sys)
  call jam_destroy(other)
  create%n = 300
  create%dim = 3
  status = jam_create(create, out=sys)
  status = jam_set_progress(sys, c_funloc(stop_at_third), c_null_ptr)
  call jam_defaults(options)
  status = jam_crunch(sys, options, report)
  call expect(status == JAM_CANCELLED .and. calls == 3, 'callback stops')
  call jam_destroy(sys)

  create%dim = 9
  status = jam_create(create, start, sys)
  call expect(status == JAM_E_DIMENSION .and. index(jam_message(), '9') > 0, 'error text')
  options%struct_size = 0
  call jam_destroy(c_null_ptr)
  deallocate (force, normal, pairs, again, wide)  ! a main program's would stay to the end, which looks like a leak
  if (failures > 0) error stop 1
  print '(a)', 'fortran layer: all as expected'
contains
  ! A sieve curve (2, rows) gives the diameters of jam_size_report; a falling one is named.
  subroutine draw_sizes()
    type(jam_diameters_options) :: law
    type(jam_size_report) :: found
    real(c_double) :: curve(2, 3)
    real(c_double), allocatable :: drawn(:)
    integer(c_size_t) :: count
    curve = reshape([1.0_c_double, 0.0_c_double, 2.0_c_double, 60.0_c_double, 4.0_c_double, 100.0_c_double], [2, 3])
    call jam_defaults(law)
    law%law = JAM_SIZES_SIEVE
    law%n = 300
    call expect(jam_diameters(law, curve, needed=count) == JAM_OK .and. count == 300, 'number of diameters')
    allocate (drawn(count))
    call expect(jam_diameters(law, curve, drawn) == JAM_OK, 'diameters')
    call expect(jam_get_size_report(3_c_int32_t, drawn, report=found) == JAM_OK, 'size report')
    call expect(abs(found%d50 - 2.0_c_double**(5.0_c_double/6.0_c_double)) < 0.02_c_double, 'd50 of the curve')
    curve(2, 2) = 120
    call expect(jam_diameters(law, curve, needed=count) == JAM_E_ARGUMENT, 'falling curve')
    call expect(index(jam_message(), 'row 2') > 0, 'its row is named')
  end subroutine draw_sizes


  ! An array the wrong way round holds as many numbers, so its length says nothing.
  subroutine shapes_and_lengths()
    type(jam_create_options) :: three
    type(c_ptr) :: made
    real(c_double) :: turned(10, 3), right(3, 10), size_one(1), cell(3, 3), turned_vectors(size(normal, 2), d)
    integer(c_int32_t) :: pair_rows(size(pairs, 2), 2)
    integer(c_int32_t), allocatable :: row(:), column(:)
    real(c_double), allocatable :: value(:), hessian(:)
    integer(c_size_t) :: entries, spheres
    integer :: i

    call jam_defaults(three)
    three%n = 10
    size_one = 0.01_c_double
    do i = 1, 10
      turned(i, :) = [0.09_c_double*i, modulo(0.37_c_double*i, 1.0_c_double), modulo(0.21_c_double*i, 1.0_c_double)]
    end do
    right = transpose(turned)
    made = c_null_ptr
    call expect(jam_create(three, turned, size_one, out=made) == JAM_E_ARGUMENT, 'x(n, 3) is refused')
    call expect(.not. c_associated(made), 'and nothing is made')
    call expect(index(jam_message(), 'transpose') > 0, 'the way out')
    call expect(jam_create(positions=turned(1:9, :), diameters=size_one, out=made) == JAM_E_ARGUMENT, 'default dim')
    cell = 0
    do i = 1, 3
      cell(i, i) = 1
    end do
    call expect(jam_create(three, turned, size_one, cell, made) == JAM_E_ARGUMENT, 'in a cell')
    call expect(jam_create(three, right, size_one, cell(:, 1:2), made) == JAM_E_ARGUMENT, 'two vectors')
    three%box = 2
    call expect(jam_create(three, right, size_one, cell, made) == JAM_E_ARGUMENT, 'box and cell')
    call expect(index(jam_message(), 'box is 2') > 0, 'both are named: '//jam_message())
    three%box = 1
    call expect(jam_create(three, right, size_one, out=made) == JAM_OK, 'x(3, n)')
    call expect(jam_set_positions(made, turned) == JAM_E_ARGUMENT, 'positions')
    call expect(jam_set_velocities(made, turned) == JAM_E_ARGUMENT, 'velocities')
    call expect(jam_set_positions(made, reshape(right, [30])) == JAM_OK, 'one dimension is C''s order')
    call expect(jam_set_positions(c_null_ptr, turned) == JAM_E_NULL, 'no system')
    call jam_destroy(made)

    call expect(jam_contact_vectors(sys, turned_vectors) == JAM_E_ARGUMENT, 'vectors out')
    call expect(jam_contacts(sys, pair_rows) == JAM_E_ARGUMENT, 'pairs out')
    call expect(jam_contacts(sys, pair_rows, size(pair_rows, kind=c_size_t), needed) == JAM_E_ARGUMENT, 'in C''s order')
    call expect(jam_forces(sys, again(1:5), needed) == JAM_E_ARGUMENT, 'a length beyond the end')
    call expect(index(jam_message(), 'out_len') > 0 .and. index(jam_message(), '5 elements') > 0, jam_message())

    call expect(jam_forces(sys, needed=entries) == JAM_OK .and. entries == size(force), 'only the size')
    call expect(jam_hessian_map(sys, needed=spheres) == JAM_OK .and. spheres > 0, 'of one array')
    call expect(jam_hessian(sys, rows=entries) == JAM_OK .and. entries > 0, 'of several')
    allocate (row(d*spheres + 1), column(entries), value(entries), hessian(entries))
    call expect(jam_hessian(sys, row_start=row, column=column, value=value) == JAM_OK, 'a Hessian')
    call expect(row(size(row)) == entries, 'all its rows')
    call expect(jam_hessian(sys, row_start=row, row_start_len=size(row, kind=c_size_t), column_len=0_c_size_t, &
                            value=hessian, value_len=entries, rows=needed) == JAM_OK, 'with lengths')
    call expect(all(hessian == value), 'the same numbers')
    call jam_set_error('of my own')
    call expect(jam_message() == 'of my own', 'the text of a caller')
  end subroutine shapes_and_lengths

  subroutine expect(truth, name)
    logical, intent(in) :: truth
    character(*), intent(in) :: name
    if (truth) return
    failures = failures + 1
    print '(3a)', 'failed: ', name, ' '//jam_message()
  end subroutine expect
end program fortran_layer
