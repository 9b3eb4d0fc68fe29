// Addresses of the site's own workers, as browsers want them that ask who has written them.

let policy;

export function trusted(address) {
  policy ??= /** @type {any} */ (window).trustedTypes?.createPolicy("lsys-worker", { createScriptURL: (text) => text });
  return policy ? policy.createScriptURL(address) : address;
}
