! The type packing: results that allocate themselves, shapes, indices from 1, arguments left out, failures by one
! handler.
module catching
  use jam_packing
  implicit none
  integer, save :: failures = 0, caught = 0, reports = 0
  character(:), allocatable, save :: text
contains
  subroutine catch(status, message)
    integer(c_int32_t), intent(in) :: status
    character(*), intent(in) :: message
    caught = caught + 1
    text = message
    if (status >= 0) error stop 'the handler got a status that is no failure'
  end subroutine catch

  function stop_at_second(progress, user) bind(c) result(stop_now)
    type(jam_progress), intent(in) :: progress
    type(c_ptr), value :: user
    integer(c_int32_t) :: stop_now
    reports = reports + 1
    stop_now = merge(1, 0, reports >= 2 .or. progress%phase < 0 .or. c_associated(user))
  end function stop_at_second

  subroutine expect(truth, name)
    logical, intent(in) :: truth
    character(*), intent(in) :: name
    if (truth) return
    failures = failures + 1
    print '(4a)', 'failed: ', name, ' ', jam_message()
  end subroutine expect
end module catching

program fortran_packing
  use catching
  implicit none
  call jam_on_error(catch)
  call network()
  call copies_and_cells()
  call soft_spheres()
  call mistakes()
  if (failures > 0) error stop 1
  print '(a)', 'fortran packing: all as expected'
contains

  subroutine network()
    type(packing) :: disks
    type(jam_crunch_report) :: report
    type(jam_modes_options) :: which
    real(c_double), allocatable :: force(:), normal(:, :), gap(:), x(:, :), sigma(:)
    real(c_double), allocatable :: lambda(:), vector(:, :, :), value(:), table(:, :)
    integer(c_int32_t), allocatable :: pair(:, :), row(:), column(:), spheres(:), z(:), near(:, :)
    real(c_double) :: net(2, 60), u(2*60), hu(2*60), r(2)
    integer :: k, m, i, j
    call disks%random(n=60, dim=2, seed=3, diameters=[(1.0_c_double + 0.4_c_double*mod(k, 2), k=1, 60)])
    report = disks%crunch()
    call expect(disks%status == JAM_OK .and. report%jammed == 1 .and. disks%why() == '', 'crunch')
    force = disks%forces()
    normal = disks%contact_vectors()
    pair = disks%contacts()
    z = disks%coordination()
    call expect(size(force) == report%contacts .and. all(shape(normal) == [2, size(force)]), 'shapes')
    call expect(minval(pair) >= 1 .and. maxval(pair) <= 60 .and. all(shape(pair) == [2, size(force)]), 'pairs from 1')
    net = 0
    do k = 1, size(force)
      net(:, pair(1, k)) = net(:, pair(1, k)) + force(k)*normal(:, k)
      net(:, pair(2, k)) = net(:, pair(2, k)) - force(k)*normal(:, k)
    end do
    call expect(maxval(abs(net)) < 1e-8_c_double, 'balance')
    call expect(sum(z) == 2*size(force) .and. count(z == 0) == report%rattlers, 'coordination')

    ! a gap, from the positions of the pair that it names
    call disks%gaps(0.5_c_double, .false., gap, near)
    x = disks%positions()
    sigma = disks%diameters()
    i = near(1, 1)
    j = near(2, 1)
    r = x(:, i) - x(:, j)
    r = r - nint(r)
    call expect(abs(norm2(r)*2/(sigma(i) + sigma(j)) - 1 - gap(1)) < 1e-12_c_double, 'gap of its pair')
    call disks%gaps(0.5_c_double, .true., pair=near)
    call expect(size(near, 2) <= size(gap) .and. size(near, 1) == 2, 'an output that is left out')

    ! the lowest mode is an eigenvector of the Hessian
    call jam_defaults(which)
    which%count = 3
    call disks%modes(o=which, table=table, vector=vector)
    lambda = table(JAM_MODE_LAMBDA + 1, :)
    call disks%hessian(row_start=row, column=column, value=value)
    spheres = disks%hessian_map()
    m = 2*size(spheres)
    call expect(size(row) == m + 1 .and. row(1) == 1 .and. row(m + 1) == size(value) + 1, 'rows from 1')
    call expect(minval(column) == 1 .and. maxval(column) == m, 'columns from 1')
    call expect(minval(spheres) >= 1 .and. all(z(spheres) > 0) .and. size(spheres) == report%stable, 'stable spheres')
    call expect(all(shape(vector) == [2, size(spheres), 3]), 'shape of modes')
    u(:m) = reshape(vector(:, :, 1), [m])
    do k = 1, m
      hu(k) = dot_product(value(row(k):row(k + 1) - 1), u(column(row(k):row(k + 1) - 1)))
    end do
    call expect(maxval(abs(hu(:m) - lambda(1)*u(:m))) < 1e-8_c_double, 'an eigenvector')
    call disks%floppy_modes([size(force)], vector=vector)
    call expect(all(shape(vector) == [2, size(spheres), 1]), 'of the last contact')
    table = disks%crunch_history()
    call expect(abs(table(JAM_HISTORY_PHI + 1, size(table, 2)) - report%packing_fraction) < 1e-12_c_double, 'history')
  end subroutine network

  subroutine copies_and_cells()
    type(packing) :: one, other
    type(jam_comparison_report) :: found
    real(c_double), allocatable :: shift(:, :), cell(:, :)
    real(c_double) :: tilted(2, 2), x(2, 2)
    type(jam_crunch_report) :: report
    call one%random(n=300, packing_fraction=0.3_c_double)
    other = one
    call expect(.not. c_associated(one%sys, other%sys), 'a copy of its own')
    call one%watch(stop_at_second)
    report = one%crunch()
    call expect(one%status == JAM_CANCELLED .and. len(one%why()) > 0 .and. caught == 0, 'stopped, which is no failure')
    call one%watch()
    call one%compare(other, found, shift)
    call expect(all(shape(shift) == [3, 300]) .and. found%displacement_max > 0, 'compare')
    call expect(any(one%positions() /= other%positions()), 'the copy did not move')
    call other%write_file('fortran_packing.xyz')
    call one%read_file('fortran_packing.xyz')
    call expect(all(one%positions() == other%positions()), 'a file has the same bits')
    tilted = reshape([1.0_c_double, 0.0_c_double, 0.3_c_double, 1.0_c_double], [2, 2])  ! a vector in each column
    x = reshape([0.1_c_double, 0.2_c_double, 0.6_c_double, 0.7_c_double], [2, 2])
    call one%from_arrays(x, [0.1_c_double], cell=tilted)
    cell = one%cell()
    call expect(all(cell == tilted), 'cell vectors in columns')
    call one%from_arrays(2*x, [0.1_c_double], box=2.0_c_double)
    call expect(all(one%positions() == 2*x) .and. all(one%diameters() == 0.1_c_double), 'from arrays')
    call other%tile(one, [3, 2])
    call expect(all(shape(other%positions()) == [2, 12]) .and. all(other%diameters() == 0.1_c_double), 'tile')
    call expect(size(jam_sizes('list:1=0.5,1.4=0.5', n=10)) == 10, 'sizes')
  end subroutine copies_and_cells

  subroutine soft_spheres()
    type(packing) :: soft
    type(jam_create_options) :: create
    type(jam_relax_report) :: minimum
    integer :: k
    call jam_defaults(create)
    create%overlap = JAM_OVERLAP_ALLOW
    call soft%random(n=60, dim=2, packing_fraction=0.95_c_double, options=create, &
                     diameters=[(1.0_c_double + 0.4_c_double*mod(k, 2), k=1, 60)])
    minimum = soft%relax()
    call expect(minimum%converged == 1 .and. minimum%force_residual < 1e-12_c_double, 'an energy minimum')
  end subroutine soft_spheres

  subroutine mistakes()
    type(packing) :: none, few
    type(jam_create_options) :: create
    real(c_double) :: turned(10, 3)
    real(c_double), allocatable :: force(:), gap(:)
    integer :: before
    before = caught
    force = none%forces()
    call expect(caught == before + 1 .and. none%status == JAM_E_NULL .and. size(force) == 0, 'nothing made')
    call expect(text == 'a packing is empty: make or read one first' .and. none%why() == text, text)
    call few%tile(none, [2, 2])
    call expect(few%status == JAM_E_NULL .and. index(text, 'empty') > 0, text)
    call few%random(n=8, dim=2)
    force = few%forces()
    call expect(few%status == JAM_E_STATE .and. size(force) == 0, 'no network: '//text)
    call few%gaps(1.0_c_double, .true., gap)
    call expect(few%status == JAM_E_STATE .and. size(gap) == 0, 'empty, not missing')
    turned = 0.5_c_double
    call few%from_arrays(turned, [0.01_c_double])
    call expect(few%status == JAM_E_ARGUMENT .and. index(text, 'x(10, 3)') > 0 .and. index(text, 'transpose') > 0, text)
    call few%from_arrays(reshape([0.5_c_double, 0.5_c_double, 0.55_c_double, 0.5_c_double], [2, 2]), [0.1_c_double])
    call expect(few%status == JAM_E_OVERLAP .and. index(text, 'spheres 1 and 2') > 0, text)
    call few%random(n=8, dim=9)
    call expect(few%status == JAM_E_DIMENSION .and. few%why() == text, text)
    call few%read_file('no/such/file.xyz')
    call expect(few%status == JAM_E_IO .and. index(text, 'no/such/file.xyz') > 0, text)
    call few%read_file('no/such/file.xyz', layout='columns=x y z')
    call few%read_checkpoint('no/such/file')
    call expect(few%status == JAM_E_IO, text)
    call expect(all(shape(few%positions()) == [2, 8]), 'a failure leaves the packing')
    call jam_defaults(create)
    create%seed = 5
    call few%from_arrays(reshape([0.2_c_double, 0.2_c_double, 0.6_c_double, 0.7_c_double], [2, 2]), [0.1_c_double], &
                         options=create)
    call expect(all(shape(few%positions()) == [2, 2]), 'the dimension is that of the positions')
  end subroutine mistakes
end program fortran_packing
