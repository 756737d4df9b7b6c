// What the page knows beyond the address: it outlives a page that is built anew in another language or unit.

const rooms = {};

// The room of a name, which `first` furnishes once.
export function kept(name, first) {
  rooms[name] ??= first();
  return rooms[name];
}
