// Light, dark, or as the system has it; remembered in this browser.

const kNames = ['system', 'light', 'dark'];

function remembered() {
  try {
    return localStorage.getItem('inkgrid-theme');
  } catch {
    return null;
  }
}

function remember(name) {
  try {
    localStorage.setItem('inkgrid-theme', name);
  } catch {
    // a browser that keeps nothing
  }
}

export function themeSwitch(button) {
  let name = kNames.includes(remembered()) ? remembered() : 'system';
  const show = () => {
    document.documentElement.dataset.theme = name;
    button.setAttribute('aria-label', name === 'system' ? 'Theme: as the system' : `Theme: ${name}`);
    button.title = button.getAttribute('aria-label');
    button.textContent = { system: '◐', light: '☀', dark: '☾' }[name];
  };
  button.onclick = () => {
    name = kNames[(kNames.indexOf(name) + 1) % kNames.length];
    remember(name);
    show();
  };
  show();
}
