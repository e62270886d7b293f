'use strict';

document.documentElement.classList.add('scripted');
setUpTables();
document.documentElement.classList.add('ready');
